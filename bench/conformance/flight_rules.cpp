// Rules that are tested in flights without faults: which frames the target sends, and when.
#include <fmt/format.h>

#include <set>

#include <array>
#include <cstdlib>
#include <map>
#include <tuple>

#include "bench/conformance/groups.hpp"
#include "bench/conformance/rules.hpp"
#include "bench/observe/values.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::conformance {
namespace {

using namespace messages;

template <class Message>
std::size_t count_of(const std::vector<Frame>& frames) {
  return static_cast<std::size_t>(std::ranges::count(frames, Message::info.id, &Frame::id));
}

std::string beats_in_flight(Subject& subject) {
  const auto flown = undisturbed(subject);
  if (!flown) return flown.error().message;
  constexpr auto expected = static_cast<std::size_t>(flight_us / TargetHeartbeat::info.cycle_time_us);
  const std::array found{std::pair("TargetHeartbeat", count_of<TargetHeartbeat>((*flown)->heard)),
                         std::pair("TargetCounters", count_of<TargetCounters>((*flown)->heard))};
  for (const auto& [name, count] : found) {
    if (count < expected || count > expected + 2)
      return fmt::format("{} {} in {:g} s, expected {}", count, name, 1e-6 * static_cast<double>(flight_us),
                         expected);
  }
  return "";
}

std::string closes_each_step(Subject& subject) {
  if (auto wrong = made_to_run(subject); !wrong.empty()) return wrong;
  subject.talk.fly(some_flight_us);
  if (!subject.talk.closed()) return "a Sync with lockstep = 1 is not answered by StepDone with its step";
  const auto samples = groups_in(subject.talk.flown());
  for (const Group& answer : groups_in(subject.talk.heard())) {
    if (!answers_something(answer.name)) continue;
    for (const Group& sample : samples) {
      if (answers(answer.name, sample.name) &&
          sample.value("time_of_validity_us") == answer.value("cause_time_us") && answer.step > sample.step)
        return fmt::format("{}: comes {} StepDone after the step of its sample", answer.name,
                           answer.step - sample.step);
    }
  }
  return "";
}

std::string protects_what_it_sends(Subject& subject) {
  const auto flown = undisturbed(subject);
  if (!flown) return flown.error().message;
  std::map<std::uint32_t, e2e::Receiver> receivers;
  for (const Frame& frame : (*flown)->heard) {
    const MessageInfo* info = find_message(frame.id, frame.extended);
    if (info == nullptr) return fmt::format("a frame with id {:x}, which is not in the DBC", frame.id);
    e2e::Receiver& receiver = receivers[frame.id];
    switch (receiver.check(frame.payload(), info->e2e_data_id)) {
      case e2e::Check::wrong_crc:
        return fmt::format("{}: wrong CRC, expected {:02x} in byte 0", info->name,
                           e2e::crc(frame.payload(), info->e2e_data_id));
      case e2e::Check::repeated:
        return fmt::format("{}: the counter stays at {}", info->name, e2e::counter(frame.payload()));
      case e2e::Check::some_lost:
        return fmt::format("{}: the counter jumps by {}", info->name, receiver.lost() + 1);
      case e2e::Check::ok:
        break;
    }
  }
  return "";
}

std::string sends_whole_groups(Subject& subject) {
  const auto flown = undisturbed(subject);
  if (!flown) return flown.error().message;
  for (const Group& answer : groups_in((*flown)->heard)) {
    std::vector<std::uint32_t> ids;
    for (const Frame& frame : answer.frames) {
      ids.push_back(frame.id);
      if (e2e::counter(frame.payload()) != answer.counter)
        return fmt::format("{}: its messages carry counters {} and {}, expected the same", answer.name,
                           e2e::counter(frame.payload()), answer.counter);
    }
    if (ids != ids_of(answer.name))
      return fmt::format("{}: {} of {} messages in the order of their ids", answer.name, ids.size(),
                         ids_of(answer.name).size());
  }
  return "";
}

enum class Cause { time, time_and_counter };

// Checks that every answer of the last flight names a sample of that flight as its cause, and that no sample
// is answered twice.
std::string causes(const Talk& talk, Cause asked) {
  const auto samples = groups_in(talk.flown());
  std::set<std::tuple<std::string_view, double, double>> answered;
  for (const Group& answer : groups_in(talk.heard())) {
    if (!answers_something(answer.name)) continue;
    const auto time = answer.value("cause_time_us"), counter = answer.value("cause_counter");
    if (!time || !counter) return fmt::format("{}: carries no cause", answer.name);
    const bool known = std::ranges::any_of(samples, [&](const Group& sample) {
      return answers(answer.name, sample.name) && (asked == Cause::time || sample.counter == *counter) &&
             sample.value("time_of_validity_us") == time;
    });
    if (!known)
      return fmt::format(
          "{}: names a cause at {:.0f} us with counter {:.0f}, expected one of the samples sent", answer.name,
          *time, *counter);
    if (!answered.emplace(answer.name, *time, *counter).second)
      return fmt::format("{}: answers the sample at {:.0f} us twice", answer.name, *time);
  }
  return answered.empty() ? "no answers" : "";
}

std::string names_its_cause(Subject& subject) {
  if (auto wrong = made_to_run(subject); !wrong.empty()) return wrong;
  subject.talk.fly(flight_us);
  return causes(subject.talk, Cause::time_and_counter);
}

std::vector<Frame> without_times_of_host(const std::vector<Frame>& frames) {
  std::vector<Frame> kept;
  std::ranges::copy_if(frames, std::back_inserter(kept), observe::is_answer);
  return kept;
}

std::string repeats_bit_for_bit(Subject& subject) {
  const auto flown = undisturbed(subject);
  if (!flown) return flown.error().message;
  if (auto wrong = made_to_run(subject); !wrong.empty()) return wrong;
  subject.talk.fly(flight_us);
  const auto first = without_times_of_host((*flown)->heard);
  const auto second = without_times_of_host(subject.talk.heard());
  if (first.size() != second.size())
    return fmt::format("{} frames, {} when the same flight is flown again", first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == second[i]) continue;
    return fmt::format("{}, frame {} of {}: other bits when the same flight is flown again",
                       observe::message_of(first[i]), i + 1, first.size());
  }
  return "";
}

// All times on the bus, except the time in Sync, are 32-bit numbers of microseconds. Such a number wraps
// after 71.6 minutes.
std::string bears_the_wrap_of_time(Subject& subject) {
  const auto flown = undisturbed(subject);
  if (!flown) return flown.error().message;
  constexpr std::int64_t wrap_us = std::int64_t{1} << 32;
  subject.talk.shift_time(wrap_us - flight_us / 2);
  std::string wrong = subject.talk.reset();
  if (wrong.empty()) {
    subject.talk.send_time();
    subject.talk.send_state();
    wrong = subject.talk.waits_for(TargetState::ready) ? subject.talk.start() : "no heartbeat says ready";
  }
  if (wrong.empty()) subject.talk.fly(flight_us);
  subject.talk.shift_time(0);
  if (!wrong.empty()) return wrong;
  const auto answered = [](const std::vector<Frame>& frames) {
    return std::ranges::count_if(groups_in(frames),
                                 [](const Group& one) { return answers_something(one.name); });
  };
  const auto before = answered((*flown)->heard), now = answered(subject.talk.heard());
  if (now != before)
    return fmt::format("{} answers in a flight across 2^32 us, {} in the same one from time 0", now, before);
  return causes(subject.talk, Cause::time);
}

constexpr Rule all[] = {
    {"P-BEAT-FLIGHT", "protocol",
     "In flight TargetHeartbeat and TargetCounters come every 100 ms of the bench's time base.",
     beats_in_flight},
    {"P-STEP", "protocol",
     "In lockstep StepDone answers each Sync with its step, after all answers to the samples before it.",
     closes_each_step},
    {"P-PROTECT", "protocol",
     "Every frame of the target has the CRC of its data id and a counter one higher than the one before.",
     protects_what_it_sends},
    {"P-GROUP", "protocol", "Answers come in whole groups, in the order of their ids, with one counter.",
     sends_whole_groups},
    {"P-CAUSE", "protocol",
     "Every answer names time and counter of a sample that was sent, and answers it once.", names_its_cause},
    {"P-REPLAY", "protocol", "The same flight gives the same bits.", repeats_bit_for_bit},
    {"P-WRAP", "protocol", "The time base may pass 2^32 us in flight.", bears_the_wrap_of_time},
};

}  // namespace

std::span<const Rule> flight_rules() { return all; }

}  // namespace canhil::conformance
