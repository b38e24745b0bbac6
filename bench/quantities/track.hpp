// One quantity over a run, as an estimator told it: what pictures, tables and bars are made of.
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

/// Of one answer, at the time of validity of its cause. SI.
struct TrackPoint {
  std::int64_t t_us = 0;
  double value = 0;                  ///< the error (estimated - true); of a statistic or an innovation itself
  std::optional<double> sigma{};     ///< of the error, told in time
  std::optional<double> estimate{};  ///< as told; angles without a jump
  std::optional<double> truth{};
};

struct Track {
  enum class Kind : std::uint8_t { error, innovation, statistic };

  const Quantity* quantity = nullptr;
  Kind kind = Kind::error;
  Unit unit{};                   ///< that pictures have
  std::string title{};           ///< of a picture of the values: "attitude error about north"
  std::string estimate_title{};  ///< of a picture of estimate and truth; empty: none is drawn
  Unit estimate_unit{};          ///< that this picture has
  bool only_if_judged = false;   ///< the values are of no interest without a bar
  Spool<TrackPoint> points{};    ///< in order of time
  /// Where answers that were owed are missing from one time to another, ends included [us], in words; empty:
  /// nowhere. Not set: wherever one waits longer than longest_wait_us.
  std::function<std::string(std::int64_t from_us, std::int64_t to_us)> unanswered{};
  double longest_wait_us = 0;       ///< from one to the next that is no silence
  std::int64_t answers_end_us = 0;  ///< after which nobody answers
  /// When the flight had which time to go, sample by sample of what the answers are to; empty: it goes to no
  /// end.
  struct ToGo {
    std::int64_t t_us = 0;
    double to_go_s = 0;
  };
  Spool<ToGo> to_go{};
  /// Values after it are beyond any picture.
  std::int64_t drawn_until_us = std::numeric_limits<std::int64_t>::max();
};

/// Takes tracks one after the other, so that a long run needs the room of one.
using TrackSink = std::function<void(Track track)>;

/// When |value_of(item)| of a series in order of time (t_us) enters a band for good [us]; none: it is outside
/// at the end.
template <class Series, class ValueOf>
std::optional<std::int64_t> entered_for_good_us(const Series& series, double within, ValueOf value_of) {
  const auto outside = std::find_if(series.rbegin(), series.rend(), [&](const auto& item) {
    return !(std::abs(value_of(item)) <= within);  // NaN is outside
  });
  if (series.empty() || outside == series.rbegin()) return std::nullopt;
  return outside.base()->t_us;
}

}  // namespace canhil::quantities
