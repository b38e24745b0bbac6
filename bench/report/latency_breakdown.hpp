// Where the time of an answer went: the mean of each part, and what no part explains.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/timing_record.hpp"

namespace canhil::report {

/// What is known of a time.
enum class Bound : std::uint8_t { exact, at_least, at_most };

/// A part of the way from the hand-over of the last frame of a stimulus to the last frame of its answer.
struct BreakdownPart {
  std::string_view key{};          ///< in the JSON
  std::string_view what{};         ///< for people
  std::optional<double> mean_s{};  ///< none: not known of this bus, or not told by the target
  Bound bound = Bound::exact;      ///< what the target tells ends at checks::most_reported_us
};

/// In the order of time; the parts that are known add up to total_s().
std::vector<BreakdownPart> parts(const checks::TimingRecord& timing);
/// Of the stimuli of one group, which the target does not account for alone: its part is in the last.
std::vector<BreakdownPart> group_parts(const checks::TimingRecord& timing,
                                       const checks::LatencyBreakdown& breakdown);
/// For people, of a key; the key itself if it is none of them.
std::string_view what_of(std::string_view key);
double total_s(const checks::LatencyBreakdown& breakdown);

}  // namespace canhil::report
