#include "bench/scenario/ssbl.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Ssbl read_ssbl(Section& section) {
  const Limits sigma = Limits::at_least(0);
  Ssbl node;
  node.schedule = read_schedule(section);
  node.ship_offset = section.three("ship_offset_m", Limits::between(-5'000, 5'000));
  node.ship_velocity = section.three("ship_velocity_mps", Limits::between(-50, 50));
  node.ship_error = {.value = section.three("ship_error_m"),
                     .sigma = section.three("ship_error_sigma_m", sigma)};
  node.bias = {.value = section.three("bias_m"), .sigma = section.three("bias_sigma_m", sigma)};
  node.noise = section.three("noise_m", sigma);
  node.range_noise = section.number("range_noise_percent", Limits::between(0, 100), 0);
  node.faults = read_fix_faults(section);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
