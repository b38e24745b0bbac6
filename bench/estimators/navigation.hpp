// Answers that tell attitude and velocity, and their errors: what the alignments have in common.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/estimators/answer_group.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::estimators {

/// Aligned attitude and velocity at the time of a slave IMU sample. rad, m/s, NED.
struct NavigationAnswer {
  std::int64_t cause_us = 0;
  world::Euler angles;
  world::Vector3 v_eb_n = world::Vector3::Zero();
  bool coasting = false;
};

/// The group of messages that tells it; the names of their signals are the same in each of the contract's.
template <class Attitude, class VelocityNE, class VelocityD>
class NavigationGroup {
 public:
  using Group = AnswerGroup<Attitude, VelocityNE, VelocityD>;

  /// True: the group is whole now.
  bool put(const Frame& frame) { return group_.put(frame); }
  Whole add(std::int64_t now_us, std::vector<NavigationAnswer>& answers) const {
    using world::units::deg;
    const auto& attitude = group_.template get<Attitude>();
    const auto& horizontal = group_.template get<VelocityNE>();
    const auto& vertical = group_.template get<VelocityD>();
    const std::int64_t cause_us = unwrap_us(vertical.cause_time_us, now_us);
    answers.push_back(
        {.cause_us = cause_us,
         .angles = {attitude.roll_deg * deg, attitude.pitch_deg * deg, attitude.heading_deg * deg},
         .v_eb_n = world::Vector3(horizontal.velocity_north_mps, horizontal.velocity_east_mps,
                                  vertical.velocity_down_mps),
         .coasting = attitude.coasting != 0});
    return Whole{
        .messages = Group::messages, .cause_us = cause_us, .cause_group = VelocityD::info.answers.front()};
  }

 private:
  Group group_;
};

/// The errors (estimated - true) of one navigation answer, at the time of validity of its cause.
struct NavigationError {
  std::int64_t t_us = 0;
  world::Euler angles;  ///< differences of the Euler angles, wrapped to +-pi
  world::Vector3 v_eb_n = world::Vector3::Zero();
  world::Vector3 misalignment = world::Vector3::Zero();  ///< phi, NED: C_estimated = exp(-[phi x]) C_true
};

/// Errors of all navigation answers whose cause lies within the truth.
std::vector<NavigationError> navigation_errors(const std::vector<NavigationAnswer>& answers,
                                               const world::FlightRecord& truth);

/// One normalised error squared.
struct Normalised {
  std::int64_t t_us = 0;
  double value = 0;
};

/// The first navigation answer that knew of a filter update: of a late fix not those between its time of
/// validity and its arrival. `navigation_us` is the cause of the last one before the update. None: nullptr.
const NavigationError* first_after(const std::vector<NavigationError>& errors, std::int64_t cause_us,
                                   std::int64_t navigation_us);

/// error' P^-1 error, with P from the sigmas and correlations (north-east, north-down, east-down) that the
/// bus carries. Infinite: P is not positive definite, as rounding may leave it, and explains no error at all.
double nees(const world::Vector3& error, const world::Vector3& sigma, const world::Vector3& correlation);

/// (error / sigma)^2 of the heading (1 degree of freedom) after an update with cause_us and navigation_us,
/// with the error from first_after(); added to `series` where there is one.
template <class Update>
void add_heading_nees(std::vector<Normalised>& series, const std::vector<NavigationError>& errors,
                      const Update& update, double sigma) {
  const NavigationError* after = first_after(errors, update.cause_us, update.navigation_us);
  if (after != nullptr) series.push_back({update.cause_us, std::pow(after->angles.heading / sigma, 2)});
}

}  // namespace canhil::estimators
