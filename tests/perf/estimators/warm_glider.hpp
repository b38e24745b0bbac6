#pragma once
// A wind filter in the middle of a flight, ready for one more navigation sample.
#include "target/estimators/wind/filter.hpp"

namespace canhil::wind {

struct WarmGlider {
  Design design;
  State state;
  FinHistory fins;
  Navigation navigation;
};

/// Runs the filter over five seconds of a flight, with 50 samples per second. The flight begins at a height
/// of 10 km, has crosswind, and is simulated with the filter's own model.
inline WarmGlider warm_glider(Algorithm algorithm, ProcessNoise noise = ProcessNoise::block_diagonal) {
  Settings settings;
  settings.algorithm = algorithm;
  settings.process_noise = noise;
  WarmGlider glider{make_design(settings), {}, {}, {}};
  const Start start{.t_us = 0,
                    .air_velocity = {250, 0, 2},
                    .v_eb_n = {250, 60, 2},
                    .omega = {0, 0, 0},
                    .attitude = {0, 0, 0},
                    .altitude = 10'000};
  glider.state = initial(start, glider.design);
  StateVector truth = glider.state.x;
  truth(air_velocity_at) += 0.5;
  const Inputs inputs{{-0.01, 0, 0}, standard_atmosphere(start.altitude)};
  for (int k = 0; k <= 250; ++k) {
    glider.fins.push(k * 20'000L, inputs.fins, glider.design.airframe.deflection_most);
    glider.navigation = {.t_us = k * 20'000L,
                         .v_eb_n = ground_velocity(truth).C_v_a + truth.tail<3>(),
                         .omega = truth.segment<3>(rate_at),
                         .attitude = truth.segment<3>(attitude_at),
                         .altitude = start.altitude,
                         .valid = true};
    if (k < 250) step(glider.state, glider.navigation, glider.fins, glider.design);
    RangeFlags outside;
    const StateVector f = derivative(truth, inputs, glider.design, outside);
    truth = predicted(truth, f, 0.02, inputs, glider.design, outside);
  }
  return glider;
}

}  // namespace canhil::wind
