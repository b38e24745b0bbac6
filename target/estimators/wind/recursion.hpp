#pragma once
// Prediction and update of x and P with all inputs good: the published recursion, what step() is made of.
#include "target/estimators/wind/correction.hpp"

namespace canhil::wind {

/// Each density, and at the least the other's.
Densities raised(Densities density, const Densities& least);

/// x and P after dt [s] with the inputs held; `density` is the process noise, raised to settings.degraded
/// where something is `outside` the model's range, before the call or by x.
void predict(StateVector& x, Covariance& P, double dt, const Inputs& inputs, const Densities& density,
             const Design& design, RangeFlags& outside, Sensitivity* sensitivity = nullptr);

/// y - h(x), angles within +-pi; `at` is ground_velocity(x).
Observation innovation_of(const Observation& y, const StateVector& x, const GroundVelocity& at);

struct Answer {
  Observation innovation;
  Observation normalised;  // whitened (correction.hpp)
  double nis = 0;          // innovation' S^-1 innovation
  double surprise = 0;     // nis + ln det S: -2 ln of the innovation's likelihood, less a constant
  double theta = 0;        // H-infinity, as used
  bool theta_capped = false;
};

/// x and P after an observation; theta is that of `interval` [s]. P becomes the inflated one for
/// Algorithm::h_infinity.
Answer update(StateVector& x, Covariance& P, const Observation& y, double interval, const Design& design);

/// The same for a caller who has the innovation already, and perhaps a sensitivity.
Answer update(StateVector& x, Covariance& P, const Observation& innovation, const GroundVelocity& at,
              double interval, const Design& design, Sensitivity* sensitivity = nullptr);

}  // namespace canhil::wind
