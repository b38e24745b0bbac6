#pragma once
// The reported values: states, wind as speed and direction, and uncertainties.
#include "target/estimators/wind/model.hpp"

namespace canhil::wind {

/// The estimates in the units of the report.
struct Estimate {
  Eigen::Vector3d air_velocity;    // body [m/s]
  Eigen::Vector3d rate, attitude;  // [rad/s]; roll, pitch, heading [rad]
  Eigen::Vector3d wind;            // velocity of the air, i.e. where the wind blows to, NED [m/s]
  double wind_speed = 0;           // horizontal [m/s]
  double wind_from = 0;        // direction from which the wind blows, clockwise from north, 0 to 2 pi [rad]
  double air_speed = 0;        // [m/s]
  double alpha = 0, beta = 0;  // [rad]
};

/// 1-sigma values. Along track: the component of the wind along the horizontal air velocity; nearly all of
/// the error is in this component. Cross track: the horizontal component to the right of the air velocity.
struct Uncertainty {
  StateVector state;
  double wind_speed = 0, wind_from = 0;     // [m/s], [rad]; pi/sqrt(3) if the direction is unknown
  double along_track = 0, cross_track = 0;  // [m/s]
};

/// The estimates of a state.
Estimate estimate(const StateVector& x);

/// The sigmas of a state with covariance P.
Uncertainty uncertainty(const StateVector& x, const Covariance& P);

}  // namespace canhil::wind
