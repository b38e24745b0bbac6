// A program for callgrind. Each measured call is in a function of its own, which is called once; callgrind
// counts the instructions of this function.
#include <cstdio>

#include "tests/perf/estimators/warm_filter.hpp"

using namespace canhil::transfer_alignment;
using canhil::strapdown::Mechanization;

#define MEASURED extern "C" [[gnu::noinline]]

MEASURED void imu_step_reference(WarmFilter& f) { propagate(f.state, f.imu, f.settings); }
MEASURED void imu_step_two_sample(WarmFilter& f) { propagate(f.state, f.imu, f.settings); }
MEASURED UpdateResult update_kalman(WarmFilter& f) { return update(f.state, f.master_velocity, f.settings); }
MEASURED UpdateResult update_robust_h2(WarmFilter& f) {
  return update(f.state, f.master_velocity, f.settings);
}
MEASURED UpdateResult update_invariant(WarmFilter& f) {
  return update(f.state, f.master_velocity, f.settings);
}
MEASURED UpdateResult update_considering(WarmFilter& f) {
  return update(f.state, f.master_velocity, f.settings);
}

int main() {
  WarmFilter reference = warm_filter(Algorithm::kalman, Mechanization::reference);
  WarmFilter kalman = warm_filter(Algorithm::kalman, Mechanization::two_sample);
  WarmFilter robust_h2 = warm_filter(Algorithm::robust_h2, Mechanization::two_sample);
  WarmFilter invariant = warm_filter(Algorithm::kalman, Mechanization::two_sample, Loop::invariant);
  WarmFilter considered =
      warm_filter(Algorithm::kalman, Mechanization::two_sample, Loop::invariant, with_ordinary_sensors());
  imu_step_reference(reference);
  imu_step_two_sample(kalman);
  const double nis = update_kalman(kalman).nis + update_robust_h2(robust_h2).nis +
                     update_invariant(invariant).nis + update_considering(considered).nis;
  std::printf("NIS %g\n", nis);
  return 0;
}
