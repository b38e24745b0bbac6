#include "bench/mapping/extract.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/mapping/reading.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/nodes/registry.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::mapping {
namespace {

// The messages of a play as they arrive; the last one completes a row.
class Group {
 public:
  explicit Group(const Play& play)
      : play_(play),
        receivers_(play.messages.size()),
        values_(play.messages.size()),
        here_(play.messages.size()),
        invalid_(play.messages.size()) {}

  void take(const LogEntry& entry, Extracted& to) {
    for (std::size_t i = 0; i < play_.messages.size(); ++i) {
      const Mapped& of = play_.messages[i].of;
      const Frame& frame = entry.frame;
      if (frame.error || frame.id != of.message->id || frame.extended != of.message->extended) continue;
      const Receiver::Taken taken = receivers_[i].take(of, frame);
      if (taken.outcome == Receiver::Outcome::part) return;
      values_[i].resize(of.plan.signals());
      const bool right = taken.outcome == Receiver::Outcome::whole;
      invalid_[i] = right && is_invalid(play_.messages[i], taken.bytes);
      if (right) static_cast<void>(of.plan.decode(taken.bytes, values_[i]));
      if (right && !has_page(play_.messages[i], values_[i])) return;  // of another play
      here_[i] = right;
      if (i + 1 == play_.messages.size()) close(entry.t_ns, to);
      return;
    }
  }

 private:
  // Whether a frame has the page that the play sends.
  static bool has_page(const PlayedMessage& played, const std::vector<double>& values) {
    return std::ranges::all_of(played.sources, [&](const Source& source) {
      return !source.signal->multiplexor || values[played.of.number(*source.signal)] == source.value;
    });
  }

  static bool is_invalid(const PlayedMessage& played, std::span<const std::uint8_t> bytes) {
    return std::ranges::any_of(played.sources, [&](const Source& source) {
      return says_invalid(*source.signal, source.invalid, bytes);
    });
  }

  void close(std::int64_t t_ns, Extracted& to) {
    const bool whole = std::ranges::find(here_, false) == here_.end();
    std::fill(here_.begin(), here_.end(), false);
    if (!whole) {
      ++to.incomplete;
      return;
    }
    if (std::ranges::find(invalid_, true) != invalid_.end()) {
      ++to.invalid;
      return;
    }
    ++to.rows;
    to.csv += fmt::format("{}.{:06}", t_ns / 1'000'000'000, t_ns / 1000 % 1'000'000);
    for (std::size_t i = 0; i < play_.messages.size(); ++i) {
      for (const Source& source : play_.messages[i].sources) {
        if (source.measurand == nullptr) continue;
        const double si = values_[i][play_.messages[i].of.number(*source.signal)] / source.factor;
        const bool rate = source.measurand->over == sensors::Over::rate;
        to.csv += fmt::format(",{}", rate ? si : si / nodes::carrier(*source.measurand).factor);
      }
    }
    to.csv += '\n';
  }

  const Play& play_;
  std::vector<Receiver> receivers_;
  std::vector<std::vector<double>> values_;  // for each message
  std::vector<bool> here_;                   // for each message: received since the last row
  std::vector<bool> invalid_;                // for each message: the latest one says that a value is invalid
};

}  // namespace

Result<Extracted> extract(const Mapping& mapping, std::string_view name, const std::string& log) {
  const auto play = std::ranges::find(mapping.plays, name, &Play::name);
  if (play == mapping.plays.end()) {
    std::string names;
    for (const Play& one : mapping.plays) names += (names.empty() ? "" : ", ") + one.name;
    return failure(
        fmt::format("{}: has no play '{}', expected one of: {}", to_text(mapping.files), name, names));
  }
  Extracted extracted{.csv = "t_s"};
  for (const PlayedMessage& message : play->messages) {
    for (const Source& source : message.sources) {
      if (source.measurand == nullptr) continue;
      const sensors::Measurand& of = *source.measurand;
      const bool rate = of.over == sensors::Over::rate;
      extracted.csv += fmt::format(",{}", rate ? of.output().rate_column : nodes::carrier(of).info.name);
    }
  }
  extracted.csv += '\n';
  auto reader = LogReader::open(log);
  if (!reader) return tl::unexpected(reader.error());
  Group group(*play);
  for (;;) {
    const auto entry = reader->next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) break;
    group.take(**entry, extracted);
  }
  if (extracted.rows == 0)
    return failure(fmt::format("{}: has no {} group of {}, expected a recording of {}", log,
                               extracted.invalid > 0 ? "valid" : "whole", name, to_text(mapping.files)));
  return extracted;
}

}  // namespace canhil::mapping
