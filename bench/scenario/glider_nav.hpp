// [glider_nav]: the glider's GPS/INS.
#pragma once

#include "bench/scenario/sample_loss.hpp"
#include "bench/scenario/schedule.hpp"

namespace canhil::scenario {

class Section;

struct GliderNav {
  Schedule schedule{};
  double velocity_noise = 0;  ///< 1-sigma of each component, NED [m/s]
  double rate_noise = 0;      ///< body [rad/s]
  double attitude_noise = 0;  ///< roll, pitch, heading [rad]
  /// Share of the variance that is a first-order Gauss-Markov process; the rest is white.
  double correlated_fraction = 0;
  double correlation_time = 60;  ///< [s]
  SampleLoss loss{};
};

GliderNav read_glider_nav(Section& section);

}  // namespace canhil::scenario
