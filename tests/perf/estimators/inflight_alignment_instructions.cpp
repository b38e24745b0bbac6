// A program for callgrind. Each measured call is in a function of its own, which is called once; callgrind
// counts the instructions of this function. Processing a fix consists of the prediction since the previous
// fix, and of the update.
#include <cstdio>

#include "tests/perf/estimators/warm_inflight_filter.hpp"

using namespace canhil::inflight_alignment;

#define MEASURED extern "C" [[gnu::noinline]]

MEASURED void imu_step(WarmInflightFilter& f) { mechanise(f.state, f.imu); }
MEASURED UpdateResult fix_ekf_15(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_ekf_18(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_ukf_15(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_ukf_18(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_sin_cos_16(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_sin_cos_19(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }
MEASURED UpdateResult fix_correlated(WarmInflightFilter& f) { return update(f.state, f.fix, f.settings); }

int main() {
  WarmInflightFilter ins = warm_inflight_filter(Algorithm::ekf, Aiding::gps);
  imu_step(ins);
  WarmInflightFilter ekf_15 = warm_inflight_filter(Algorithm::ekf, Aiding::gps);
  WarmInflightFilter ekf_18 = warm_inflight_filter(Algorithm::ekf, Aiding::ssbl);
  WarmInflightFilter ukf_15 = warm_inflight_filter(Algorithm::ukf, Aiding::gps);
  WarmInflightFilter ukf_18 = warm_inflight_filter(Algorithm::ukf, Aiding::ssbl);
  WarmInflightFilter sin_cos_16 = warm_inflight_filter(Algorithm::sin_cos, Aiding::gps);
  WarmInflightFilter sin_cos_19 = warm_inflight_filter(Algorithm::sin_cos, Aiding::ssbl);
  WarmInflightFilter correlated = warm_inflight_filter(Algorithm::sin_cos, Aiding::ssbl, 1);
  const double nis = fix_ekf_15(ekf_15).nis + fix_ekf_18(ekf_18).nis + fix_ukf_15(ukf_15).nis +
                     fix_ukf_18(ukf_18).nis + fix_sin_cos_16(sin_cos_16).nis +
                     fix_sin_cos_19(sin_cos_19).nis + fix_correlated(correlated).nis;
  std::printf("NIS %g\n", nis);
  return 0;
}
