#include "bench/scenario/initial_error.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

world::NavigationErrorModel read_initial_error(Section& section) {
  const Limits sigma = Limits::at_least(0);
  world::NavigationErrorModel model{
      .position = {.value = section.three("position_m"), .sigma = section.three("position_sigma_m", sigma)},
      .velocity = {.value = section.three("velocity_mps"),
                   .sigma = section.three("velocity_sigma_mps", sigma)},
      .attitude = {.value = section.three("attitude_deg", Limits::between(-180, 180)),
                   .sigma = section.three("attitude_sigma_deg", Limits::between(0, 180))}};
  section.finish();
  return model;
}

}  // namespace canhil::scenario
