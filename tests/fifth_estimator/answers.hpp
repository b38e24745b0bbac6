// The answers of a baro-inertial height filter.
#pragma once

#include <memory>

#include "bench/checks/reception.hpp"
#include "bench/world/flight_record.hpp"
#include "dbc/spool/in_order.hpp"

namespace canhil::estimators {

/// Group Height: the state after the update with a barometric height. The state and this height are valid at
/// the same time. SI units.
struct HeightAnswer {
  std::int64_t cause_us = 0;
  double height = 0;  ///< above the ellipsoid
  double height_sigma = 0;
  double velocity_down = 0;
  double velocity_down_sigma = 0;
  double nis = 0;
  bool used = false;  ///< false: the height was gated
};
using HeightAnswers = TimeOrdered<HeightAnswer, &HeightAnswer::cause_us>;

std::unique_ptr<Reception> height_reception();

/// Errors (estimated - true) of one answer.
struct HeightError {
  double height = 0, velocity_down = 0;
};
HeightError error_of(const HeightAnswer& answer, const world::FlightRecord& flight);

}  // namespace canhil::estimators
