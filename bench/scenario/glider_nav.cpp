#include "bench/scenario/glider_nav.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

GliderNav read_glider_nav(Section& section) {
  const Limits sigma = Limits::at_least(0);
  GliderNav node;
  node.schedule = read_glide_schedule(section);
  node.velocity_noise = section.number("velocity_noise_mps", sigma, 0);
  node.rate_noise = section.number("rate_noise_degps", sigma, 0);
  node.attitude_noise = section.number("attitude_noise_deg", Limits::between(0, 45), 0);
  node.correlated_fraction = section.number("correlated_fraction", Limits::between(0, 1), 0);
  node.correlation_time = section.number("correlation_time_s", Limits::above(0), node.correlation_time);
  node.loss = read_sample_loss(section);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
