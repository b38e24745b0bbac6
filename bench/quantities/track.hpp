// The track of a quantity: its course over a run as an estimator reported it. Pictures, tables and checks use
// tracks.
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
#include "bench/spool/spool.hpp"

namespace canhil::quantities {

/// One answer, at the time of validity of its cause. SI.
struct TrackPoint {
  std::int64_t t_us = 0;
  double value = 0;  ///< the error (estimated - true); for a statistic or an innovation, the value itself
  std::optional<double> sigma{};     ///< reported sigma of the error; none: not reported in time
  std::optional<double> estimate{};  ///< as reported; angles unwrapped
  std::optional<double> truth{};
};

struct Track {
  enum class Kind : std::uint8_t { error, innovation, statistic };

  const Quantity* quantity = nullptr;
  Kind kind = Kind::error;
  Unit unit{};                   ///< for pictures
  std::string title{};           ///< title of a picture of the values: "attitude error about north"
  std::string estimate_title{};  ///< title of a picture of estimate and truth; empty: no picture
  Unit estimate_unit{};          ///< for the picture of estimate and truth
  bool only_if_judged = false;   ///< drawn only if a check has a limit for it
  Spool<TrackPoint> points{};    ///< in order of time
  /// Describes where due answers are missing between two times, ends included [us]; empty: nowhere. If not
  /// set, any wait longer than longest_wait_us is a gap.
  std::function<std::string(std::int64_t from_us, std::int64_t to_us)> unanswered{};
  double longest_wait_us = 0;       ///< the longest time between answers that does not count as silence
  std::int64_t answers_end_us = 0;  ///< no answers are expected after this time
  /// The time to go at each stimulus; empty: the flight has no closest approach.
  struct ToGo {
    std::int64_t t_us = 0;
    double to_go_s = 0;
  };
  Spool<ToGo> to_go{};
  /// Later values are not drawn.
  std::int64_t drawn_until_us = std::numeric_limits<std::int64_t>::max();
};

/// Takes tracks one at a time, so that memory holds only one.
using TrackSink = std::function<void(Track track)>;

/// The time from which |value_of(item)| of a time series (t_us) stays within a band to the end [us]; none: it
/// is outside the band at the end.
template <class Series, class ValueOf>
std::optional<std::int64_t> entered_for_good_us(const Series& series, double within, ValueOf value_of) {
  const auto outside = std::find_if(series.rbegin(), series.rend(), [&](const auto& item) {
    return !(std::abs(value_of(item)) <= within);  // NaN is outside
  });
  if (series.empty() || outside == series.rbegin()) return std::nullopt;
  return outside.base()->t_us;
}

}  // namespace canhil::quantities
