#pragma once
// The paper's flight (level, heading 0, 500 km/h north for 10 s, then 9.81 m/s^2 north) and its error-free
// IMU, as in the published test vectors.
#include <Eigen/Core>

#include "target/estimators/strapdown/mechanization.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

inline constexpr double flight_acceleration = 9.81;  // [m/s^2]

strapdown::NavState flight_start();

/// The slave's navigation state with the errors (computed - true) dV [m/s] and phi [rad] relative to `nav`.
strapdown::NavState with_errors(strapdown::NavState nav, const Eigen::Vector3d& dV,
                                const Eigen::Vector3d& phi);

/// The start of the published runs, with errors of 5 deg and 1 m/s on each axis.
strapdown::NavState published_start();

/// The true state at t + dt [s]; `nav` is the true state at t [s]. The acceleration is constant during the
/// sample, and the latitude is integrated by the trapezoidal rule.
strapdown::NavState flight_next(const strapdown::NavState& nav, double t, double dt);

/// The increments of the sample from t to t + dt: mean rate and mean specific force, with the earth terms at
/// the middle of the sample.
strapdown::ImuIncrement flight_increment(const strapdown::NavState& nav, double t, double dt);

}  // namespace canhil::transfer_alignment
