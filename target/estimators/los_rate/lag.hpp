#pragma once
// The lag of Algorithm::combined after a sudden turn of the target, which white jerk does not model.
#include "target/estimators/los_rate/filter.hpp"

namespace canhil::los_rate {

/// Notes in the state what the mean of the innovations [rad] says about the lag of the rate, at an update
/// with the gains K1 of the error angle and the innovation's variances S [rad^2]. Does nothing for the other
/// algorithms.
///
/// After a sudden turn of the target, the errors of a filter with third-order Butterworth poles of bandwidth
/// Om satisfy e_w = e_e' + 2 Om e_e, and K1 is 2 Om Ts; so the innovations show a lag of the rate early,
/// whatever its size. The lag is taken as 2 K1/Ts, which is 4 Om, times the mean; the part of the mean that
/// noise explains (1.5 sigma) does not count.
void note_lag(State& state, Plane innovation, const Planes<double>& K1, const Planes<double>& S,
              const Design& design);

}  // namespace canhil::los_rate
