#include "bench/mapping/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/mapping/range.hpp"
#include "dbc/parser/database.hpp"

namespace canhil::mapping {
namespace {

using Grade = Remark::Grade;

constexpr double most_of_sensor_noise = 0.25;  // limit of step / sqrt(12), as a fraction of the sensor sigma

class Remarks {
 public:
  Remarks(const Mapping& mapping, const FlownValues& flown) : mapping_(mapping), flown_(flown) {}

  std::vector<Remark> all() {
    for (const Play& play : mapping_.plays) on(play);
    for (const Hear& hear : mapping_.hears) on(hear);
    on_messages_that_nobody_hears();
    return std::move(remarks_);
  }

 private:
  void add(Grade grade, std::string_view rule, std::string subject, std::string what) {
    remarks_.push_back(
        {.grade = grade, .rule = std::string(rule), .subject = std::move(subject), .what = std::move(what)});
  }
  static std::string name(const Mapped& of, const dbc::Signal& signal) {
    return of.message->name + "." + signal.name;
  }

  // Whether a signal occupies exactly the bits of the counter, of the checksum or of a constant of the
  // message's protection.
  static bool is_protection(const Mapped& of, const dbc::Signal& signal) {
    if (!of.protection) return false;
    const protection::Settings& settings = of.protection->settings();
    const protection::Place place{.start_bit = signal.start_bit,
                                  .length = signal.length,
                                  .big_endian = signal.byte_order == dbc::ByteOrder::big_endian};
    return (settings.counter && settings.counter->place == place) ||
           (settings.checksum && settings.checksum->place == place) ||
           std::ranges::find(settings.constants, place, &protection::Constant::place) !=
               settings.constants.end();
  }

  void on(const Play& play) {
    for (const PlayedMessage& one : play.messages) {
      for (const dbc::Signal& signal : one.of.message->signals) {
        const bool played = std::ranges::find(one.sources, &signal, &Source::signal) != one.sources.end();
        // A multiplexed signal needs no value, because it is sent only if the play also sends the value of
        // the multiplexor that selects this signal.
        if (!played && signal.multiplexed_by.empty() && !is_protection(one.of, signal))
          add(Grade::warning, "unmapped", name(one.of, signal),
              "no value is mapped to it: it is encoded from 0");
      }
      if (!one.of.protection)
        add(Grade::note, "unprotected", one.of.message->name, "has neither counter nor checksum here");
      for (const Source& source : one.sources) {
        if (const auto found = flown_.find(&source); found != flown_.end()) on(one.of, source, found->second);
      }
    }
    const dbc::Message& last = *play.messages.back().of.message;
    if (last.cycle_time_us != 0 && last.cycle_time_us != play.period_us)
      add(Grade::warning, "cycle-time", last.name,
          fmt::format("is played every {:g} ms, the DBC says {:g} ms",
                      1e-3 * static_cast<double>(play.period_us),
                      1e-3 * static_cast<double>(last.cycle_time_us)));
  }

  void on(const Mapped& of, const Source& source, const PlayedValues& values) {
    const dbc::Signal& signal = *source.signal;
    if (signal.is_float()) return;
    const double step = std::abs(signal.scale), rounding = step / std::sqrt(12.0);
    if (values.noise > 0 && rounding > most_of_sensor_noise * values.noise)
      add(Grade::warning, "coarse", name(of, signal),
          fmt::format("its step of {:g} {} adds {:.2g} of rounding noise to the sensor's noise of {:.2g}",
                      step, signal.unit, rounding, values.noise));
    if (dbc::holds(signal, values.lowest) && dbc::holds(signal, values.highest)) return;
    const auto [low, high] = physical_range(signal).value_or(std::pair(0.0, 0.0));
    add(Grade::warning, "clipped", name(of, signal),
        fmt::format("holds {:g} to {:g} {}; the flight's values are {:g} to {:g}", low, high, signal.unit,
                    values.lowest, values.highest));
  }

  void on(const Hear& hear) {
    for (const dbc::Signal& signal : hear.of.message->signals) {
      const bool reported = std::ranges::find(hear.reported_signals, &signal, &ReportedSignal::signal) !=
                            hear.reported_signals.end();
      const bool echo = hear.echo && hear.echo->repeated == &signal;
      const bool flag = std::ranges::find(hear.flags, &signal, &ReportedFlag::signal) != hear.flags.end();
      const bool part = hear.quaternion &&
                        std::ranges::find(hear.quaternion->parts, &signal) != hear.quaternion->parts.end();
      if (!reported && !echo && !flag && !part && !is_protection(hear.of, signal))
        add(Grade::note, "unheard", name(hear.of, signal), "is not used by the bench");
    }
    if (!hear.of.protection)
      add(Grade::note, "unprotected", hear.of.message->name, "is not checked: neither counter nor checksum");
    if (hear.is_owed() && !hear.echo)
      add(Grade::note, "no-echo", hear.of.message->name,
          "does not name its cause: the latest stimulus before it is taken, and virtual time cannot wait for "
          "it");
    if (!hear.answers && mapping_.messages[hear.of.index].cycle_time_us == 0)
      add(Grade::warning, "no-cycle-time", hear.of.message->name,
          "answers nothing and has no cycle time in the DBC: its period cannot be judged");
  }

  void on_messages_that_nobody_hears() {
    std::set<std::string> senders;
    for (const Hear& hear : mapping_.hears) senders.insert(hear.of.message->sender);
    for (const dbc::Message& message : mapping_.targets.front().database.messages) {
      const bool mapped =
          std::ranges::find(mapping_.messages, message.name, &MessageInfo::name) != mapping_.messages.end();
      if (!mapped && !message.sender.empty() && senders.contains(message.sender))
        add(Grade::note, "unheard", message.name, "is sent by the target too but not used by the bench");
    }
  }

  const Mapping& mapping_;
  const FlownValues& flown_;
  std::vector<Remark> remarks_;
};

}  // namespace

std::vector<Remark> remarks_on(const Mapping& mapping, const FlownValues& flown) {
  return Remarks(mapping, flown).all();
}

double load_of(const Mapping& mapping, const wire::BitRates& rates) {
  double load = 0;
  const auto add = [&](const Mapped& of, std::int64_t period_us) {
    if (period_us == 0) return;
    const dbc::Message& message = *of.message;
    load += static_cast<double>(of.frames()) *
            wire::bus_load(message.fd ? wire::worst_case_fd_length(of.frame_size(), message.extended, true)
                                      : wire::worst_case_length(of.frame_size(), message.extended),
                           1e-6 * static_cast<double>(period_us), rates);
  };
  for (const Play& play : mapping.plays) {
    for (const PlayedMessage& one : play.messages) add(one.of, play.period_us);
  }
  for (const Hear& hear : mapping.hears)
    add(hear.of, hear.is_owed() ? mapping.plays[*hear.answers].period_us
                                : mapping.messages[hear.of.index].cycle_time_us);
  return load;
}

}  // namespace canhil::mapping
