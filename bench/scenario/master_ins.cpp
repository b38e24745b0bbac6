#include "bench/scenario/master_ins.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

MasterIns read_master_ins(Section& section) {
  const Limits sigma = Limits::at_least(0);
  MasterIns node;
  node.schedule = read_schedule(section);
  node.errors = {.position = {.value = section.three("position_bias_m"),
                              .sigma = section.three("position_noise_m", sigma)},
                 .velocity = {.value = section.three("velocity_bias_mps"),
                              .sigma = section.three("velocity_noise_mps", sigma)},
                 .attitude = {.value = section.three("attitude_bias_deg", Limits::between(-180, 180)),
                              .sigma = section.three("attitude_noise_deg", Limits::between(0, 180))}};
  node.loss = read_sample_loss(section);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
