// Building blocks for an estimator's tracks.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::estimators {

/// The longest gap [us] between two messages with the name `message`. A longer gap counts as silence.
inline double longest_wait_us(const checks::Observations& seen, std::string_view message) {
  return checks::longest_wait_us(1e6 * checks::nominal_period_s(seen, message));
}

/// For each of the axes north, east and down, calls visit(quantity, name of the axis, index of the axis).
template <class Visit>
void each_axis(const std::array<const quantities::Quantity*, 3>& ned, Visit visit) {
  visit(*ned[0], std::string("north"), 0);
  visit(*ned[1], std::string("east"), 1);
  visit(*ned[2], std::string("down"), 2);
}

/// The same track, but drawn only if a check judges it.
inline quantities::Track judged(quantities::Track track) {
  track.only_if_judged = true;
  return track;
}

/// Properties that all tracks of one series of answers share; see quantities::Track.
struct Answering {
  double longest_wait_us = 0;
  std::int64_t answers_end_us = 0;
  std::function<std::string(std::int64_t from_us, std::int64_t to_us)> unanswered{};

  /// A track without points.
  [[nodiscard]] quantities::Track track(const quantities::Quantity& quantity, std::string title) const {
    return {.quantity = &quantity,
            .unit = quantity.unit,
            .title = std::move(title),
            .unanswered = unanswered,
            .longest_wait_us = longest_wait_us,
            .answers_end_us = answers_end_us};
  }
  [[nodiscard]] quantities::Track statistic(const quantities::Quantity& quantity, std::string title,
                                            Spool<quantities::TrackPoint> values) const {
    quantities::Track of = track(quantity, std::move(title));
    of.kind = quantities::Track::Kind::statistic;
    of.points = std::move(values);
    return of;
  }
};

}  // namespace canhil::estimators
