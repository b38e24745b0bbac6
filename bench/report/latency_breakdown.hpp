// The parts of an answer's latency: the mean of each part, and the unexplained rest.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/timing_record.hpp"

namespace canhil::report {

/// Whether a time is exact or a bound.
enum class Bound : std::uint8_t { exact, at_least, at_most };

/// A part of the time from the hand-over of a stimulus's last frame to the last frame of its answer.
struct BreakdownPart {
  std::string_view key{};          ///< key in the JSON report
  std::string_view what{};         ///< label for people
  std::optional<double> mean_s{};  ///< none: unknown on this bus, or not reported by the target
  Bound bound = Bound::exact;      ///< a bound if values of the target saturated at checks::most_reported_us
};

/// The parts in the order of time; the known parts add up to total_s().
std::vector<BreakdownPart> parts(const checks::TimingRecord& timing);
/// The parts for the stimuli of one group. The target does not report times for single groups, so the last
/// part includes the time of the target.
std::vector<BreakdownPart> group_parts(const checks::TimingRecord& timing,
                                       const checks::LatencyBreakdown& breakdown);
/// The label of a part; the key itself if the part has no label.
std::string_view what_of(std::string_view key);
double total_s(const checks::LatencyBreakdown& breakdown);

}  // namespace canhil::report
