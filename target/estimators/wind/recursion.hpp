#pragma once
// Prediction and update of x and P for valid inputs: the published recursion, which step() uses.
#include "target/estimators/wind/correction.hpp"

namespace canhil::wind {

/// For each density, the larger of its values in `density` and in `least`.
Densities raised(Densities density, const Densities& least);

/// Predicts x and P over dt [s] with constant inputs. `density` is the process noise; it is raised to
/// settings.degraded if `outside` is set before the call or x is outside the model's range.
void predict(StateVector& x, Covariance& P, double dt, const Inputs& inputs, const Densities& density,
             const Design& design, RangeFlags& outside, Sensitivity* sensitivity = nullptr);

/// y - h(x), angles in [-pi, pi]; `at` is ground_velocity(x).
Observation innovation_of(const Observation& y, const StateVector& x, const GroundVelocity& at);

/// The result of an update.
struct Answer {
  Observation innovation;
  Observation normalised;  // whitened (correction.hpp)
  Observation lasting;     // variance by lasting errors, per variance by noise
  double nis = 0;          // innovation' S^-1 innovation
  double surprise = 0;     // nis + ln det S: -2 ln of the innovation's likelihood, minus a constant
  double theta = 0;        // H-infinity, as used
  bool theta_capped = false;
};

/// Updates x and P by an observation; theta is computed for `interval` [s]. With Algorithm::h_infinity the
/// update also inflates P.
Answer update(StateVector& x, Covariance& P, const Observation& y, double interval, const Design& design);

/// update() for a caller that has computed the innovation, and optionally has a sensitivity.
Answer update(StateVector& x, Covariance& P, const Observation& innovation, const GroundVelocity& at,
              double interval, const Design& design, Sensitivity* sensitivity = nullptr);

}  // namespace canhil::wind
