// The track of a quantity: its values over the time of a run, as an estimator reported them. Pictures, tables
// and checks use tracks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "bench/quantities/quantity.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::quantities {

/// The values from one answer, in SI. t_us is the time of validity of the answer's cause.
struct TrackPoint {
  std::int64_t t_us = 0;
  /// The error (estimated - true); for a statistic or an innovation: the statistic or innovation itself.
  double value = 0;
  std::optional<double> sigma{};     ///< reported sigma of the error; nullopt: not reported in time
  std::optional<double> estimate{};  ///< the reported estimate; angles are unwrapped
  std::optional<double> truth{};
};

struct Track {
  enum class Kind : std::uint8_t { error, innovation, statistic };

  const Quantity* quantity = nullptr;
  Kind kind = Kind::error;
  Unit unit{};                          ///< unit in pictures
  std::string title{};                  ///< title of a picture of the values: "attitude error about north"
  std::string estimate_title{};         ///< title of a picture of estimate and truth; empty: no picture
  Unit estimate_unit{};                 ///< unit in the picture of estimate and truth
  bool only_if_judged = false;          ///< drawn only if a check has a limit for this quantity
  Spool<TrackPoint> points{};           ///< in order of time
  Spool<std::int64_t> without_truth{};  ///< times of answers at which the truth has no value, ascending
  /// Looks for missing answers that were due between two times [us], both included. Returns a description of
  /// the place where they are missing, or an empty string if none is missing. If this function is not set,
  /// any wait longer than longest_wait_us counts as a gap.
  std::function<std::string(std::int64_t from_us, std::int64_t to_us)> unanswered{};
  double longest_wait_us = 0;       ///< the longest time between answers that does not count as silence
  std::int64_t answers_end_us = 0;  ///< no answers are expected after this time
  /// The time to go at one stimulus. Only tracks of quantities with a time to go have it.
  struct ToGo {
    std::int64_t t_us = 0;
    double to_go_s = 0;
  };
  Spool<ToGo> to_go{};
  /// Values after this time are not drawn.
  std::int64_t drawn_until_us = std::numeric_limits<std::int64_t>::max();
};

/// A function that receives one track after the other, so that only one track is in memory at a time.
using TrackSink = std::function<void(Track track)>;

/// The time [us] from which |value_of(item)| of a time series stays at or below `within` until the end of the
/// series; nullopt: the series is empty or ends above `within`. The items have a member t_us.
template <class Series, class ValueOf>
std::optional<std::int64_t> entered_for_good_us(const Series& series, double within, ValueOf value_of) {
  const auto outside = std::find_if(series.rbegin(), series.rend(), [&](const auto& item) {
    return !(std::abs(value_of(item)) <= within);  // NaN is outside
  });
  if (series.empty() || outside == series.rbegin()) return std::nullopt;
  return outside.base()->t_us;
}

}  // namespace canhil::quantities
