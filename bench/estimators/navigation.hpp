// Answers with attitude and velocity, and their errors: shared by the alignment estimators.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "bench/estimators/answer_group.hpp"
#include "bench/quantities/track.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::estimators {

/// Attitude and velocity, as aligned by the estimator, at the time of a sample of the slave IMU. Units: rad
/// and m/s; axes: NED.
struct NavigationAnswer {
  std::int64_t cause_us = 0;
  world::Euler angles;
  world::Vector3 v_eb_n = world::Vector3::Zero();
  bool coasting = false;
};

/// The message group that carries a NavigationAnswer. The signals have the same names in the groups of all
/// alignment estimators.
template <class Attitude, class VelocityNE, class VelocityD>
struct NavigationGroup : AnswerGroup<Attitude, VelocityNE, VelocityD> {
  template <class Answers>
  void add(std::int64_t cause_us, Answers& answers) const {
    using world::units::deg;
    const auto& attitude = this->template get<Attitude>();
    const auto& horizontal = this->template get<VelocityNE>();
    const auto& vertical = this->template get<VelocityD>();
    answers.navigation.push_back(
        {.cause_us = cause_us,
         .angles = {attitude.roll_deg * deg, attitude.pitch_deg * deg, attitude.heading_deg * deg},
         .v_eb_n = world::Vector3(horizontal.velocity_north_mps, horizontal.velocity_east_mps,
                                  vertical.velocity_down_mps),
         .coasting = attitude.coasting != 0});
  }
};

/// The errors (estimated - true) of one navigation answer, at the time of validity of its cause.
struct NavigationError {
  std::int64_t t_us = 0;
  world::Euler angles;  ///< differences of the Euler angles, wrapped to +-pi
  world::Vector3 v_eb_n = world::Vector3::Zero();
  world::Vector3 misalignment = world::Vector3::Zero();  ///< phi, NED: C_estimated = exp(-[phi x]) C_true
  std::size_t answer = 0;                                ///< index of the navigation answer
};

/// The navigation answers of a run, and their errors.
struct NavigationAnswers : InOrderOfCause<NavigationAnswer> {
  using InOrderOfCause<NavigationAnswer>::InOrderOfCause;

  /// The errors of all answers whose cause lies within the flight record. They are computed once for a run:
  /// its checks, results, pictures and tables read the same series.
  [[nodiscard]] const Spool<NavigationError>& errors(const world::FlightRecord& truth) const;
  /// The error of the first navigation answer that includes a filter update with the cause `cause_us`.
  /// `navigation_us` is the latest cause of the navigation answers that arrived before the update; the cause
  /// of the answer is later than both times. If a fix arrives late, the navigation answers between its time
  /// of validity and its arrival do not include its update. None: no such answer follows the update. Only
  /// this error is computed: a campaign needs no others.
  [[nodiscard]] std::optional<NavigationError> first_after(std::int64_t cause_us, std::int64_t navigation_us,
                                                           const world::FlightRecord& truth) const;

 private:
  mutable Spool<NavigationError> errors_;
  mutable const world::FlightRecord* truth_ = nullptr;  // the truth and the answers that errors_ is of
  mutable std::uint64_t of_revision_ = 0;
};

/// The latest cause of the navigation answers so far; -1: no answer.
inline std::int64_t latest_cause_us(const NavigationAnswers& navigation) {
  return navigation.latest().value_or(-1);
}

/// The normalised estimation error squared, error^T P^-1 error. The covariance P is computed from the sigmas
/// and the correlations (north-east, north-down, east-down) on the bus. The result is infinite if P is not
/// positive definite because of rounding on the bus: such a P explains no error.
double nees(const world::Vector3& error, const world::Vector3& sigma, const world::Vector3& correlation);

/// Appends one point to `series`: (error / sigma)^2 of the heading (1 degree of freedom) after the update
/// `update`. The error comes from first_after(); without such an error, nothing is appended. `update` has the
/// members cause_us, navigation_us and attitude_sigma.
template <class Update>
void add_heading_nees(Spool<quantities::TrackPoint>& series, const NavigationAnswers& navigation,
                      const world::FlightRecord& truth, const Update& update) {
  const auto after = navigation.first_after(update.cause_us, update.navigation_us, truth);
  if (after)
    series.push_back(
        {.t_us = update.cause_us, .value = std::pow(after->angles.heading / update.attitude_sigma.z(), 2)});
}

}  // namespace canhil::estimators
