#include "bench/scenario/gps.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Gps read_gps(Section& section) {
  const Limits sigma = Limits::at_least(0);
  Gps node;
  node.schedule = read_schedule(section);
  node.bias = {.value = section.three("bias_m"), .sigma = section.three("bias_sigma_m", sigma)};
  node.noise = section.three("noise_m", sigma);
  if (section.has("lowest_height_m")) node.lowest_height = section.number("lowest_height_m", Limits{});
  section.optional("lowest_height_m");
  node.faults = read_fix_faults(section);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
