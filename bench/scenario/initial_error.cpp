#include "bench/scenario/initial_error.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

world::InitialErrorModel read_initial_error(Section& section) {
  const Limits sigma = Limits::at_least(0);
  world::InitialErrorModel model;
  model.position = {.value = section.three("position_m"), .sigma = section.three("position_sigma_m", sigma)};
  model.velocity = {.value = section.three("velocity_mps"),
                    .sigma = section.three("velocity_sigma_mps", sigma)};
  model.attitude = {.value = section.three("attitude_deg", Limits::between(-180, 180)),
                    .sigma = section.three("attitude_sigma_deg", Limits::between(0, 180))};
  model.heading_sigma = section.number("heading_sigma_deg", Limits::between(0, 180), 0);
  model.heading_magnitude = section.number("heading_magnitude_deg", Limits::between(0, 180), 0);
  if (model.heading_sigma > 0 && model.heading_magnitude > 0)
    section.reject("heading_magnitude_deg", "is given beside 'heading_sigma_deg'", "only one of the two");
  section.finish();
  return model;
}

}  // namespace canhil::scenario
