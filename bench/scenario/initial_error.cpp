#include "bench/scenario/initial_error.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

world::InitialErrorModel read_initial_error(Section& section) {
  const Limits sigma = Limits::at_least(0);
  world::InitialErrorModel model;
  model.position = {.value = section.three({"position_m", "Fixed error of the initial position, [N, E, D]."}),
                    .sigma = section.three({"position_sigma_m",
                                            "1-sigma of a random error of the initial position. The error is "
                                            "drawn for each run and added to `position_m`."},
                                           sigma)};
  model.velocity = {
      .value = section.three({"velocity_mps", "Fixed error of the initial velocity, [N, E, D]."}),
      .sigma = section.three({"velocity_sigma_mps",
                              "1-sigma of a random error of the initial velocity. The error is drawn for "
                              "each run and added to `velocity_mps`."},
                             sigma)};
  model.attitude = {
      .value = section.three({"attitude_deg", "Fixed misalignments about north, east and down."},
                             Limits::between(-180, 180)),
      .sigma = section.three(
          {"attitude_sigma_deg",
           "1-sigma of random misalignments. They are drawn for each run and added to `attitude_deg`."},
          Limits::between(0, 180))};
  model.heading_sigma = section.number({"heading_sigma_deg",
                                        "1-sigma of a random error of the heading, drawn for each run. This "
                                        "error may be large; it does not change the tilts."},
                                       Limits::between(0, 180), 0);
  model.heading_magnitude = section.number(
      {"heading_magnitude_deg",
       "Magnitude of an error of the heading whose sign is random, in place of `heading_sigma_deg`."},
      Limits::between(0, 180), 0);
  if (model.heading_sigma > 0 && model.heading_magnitude > 0)
    section.reject("heading_magnitude_deg", "is given beside 'heading_sigma_deg'", "only one of the two");
  section.finish();
  return model;
}

}  // namespace canhil::scenario
