#pragma once
// An in-flight alignment during a turn of the vehicle, ready for one more IMU sample or one more fix. The
// motion is artificial; the settings match the sensors of the paper.
#include <cmath>

#include "target/estimators/inflight_alignment/filter.hpp"
#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::inflight_alignment {

struct WarmInflightFilter {
  Settings settings;
  State state;  // 1 s after the last update
  strapdown::ImuIncrement imu;
  GeodeticPosition fix;
};

/// `correlated_share`: of the variance of the fixes, as the device's default 1 tells it; see Settings.
inline WarmInflightFilter warm_inflight_filter(Algorithm algorithm, Aiding aiding,
                                               double correlated_share = 0) {
  WarmInflightFilter filter;
  filter.settings.algorithm = algorithm;
  filter.settings.aiding = aiding;
  filter.settings.fix_correlated_share = correlated_share;
  strapdown::NavState start;
  start.latitude = 0.61;
  start.v_eb_n << 2.3, 1.8, 0;
  start.C_bn = strapdown::dcm_from_euler({0.02, -0.01, -0.8});
  filter.fix = {start.latitude, 0, 0};
  filter.state = initial(start, filter.settings);
  for (int k = 1; k <= 550; ++k) {
    filter.imu = {{1e-5, 1e-4, 0.003 * std::cos(k * 0.004)}, {1e-4, 3e-3, -0.196}, 0.02};
    propagate(filter.state, filter.imu, filter.settings);
    filter.fix.latitude += 2e-8 * std::sin(k * 0.01);
    if (k % 50 == 0 && k < 550) update(filter.state, filter.fix, filter.settings);
  }
  return filter;
}

}  // namespace canhil::inflight_alignment
