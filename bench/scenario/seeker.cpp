#include "bench/scenario/seeker.hpp"

#include <cmath>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

// KEY and KEY with _sigma before the unit: a given value and what each run draws beside it.
world::RandomValue read_constant(Section& section, std::string_view key, std::string_view sigma_key,
                                 double sigma) {
  return {.value = section.number(key, Limits{}, 0),
          .sigma = section.number(sigma_key, Limits::at_least(0), sigma)};
}

world::SeekerErrorModel read_errors(Section& section) {
  const Limits sigma = Limits::at_least(0);
  return {.thermal = section.number("thermal_noise_radpm2", sigma, 1e-10),
          .glint = section.number("glint_noise_m", sigma, 0.5),
          .glint_correlation = section.number("glint_correlation_ms", sigma, 0),
          .constant = section.number("constant_noise_mrad", sigma, 0),
          .gyro_noise = section.number("gyro_noise_mradps", sigma, 1),
          .gyro_bias = read_constant(section, "gyro_bias_mradps", "gyro_bias_sigma_mradps", 0.5),
          .accel_noise = section.number("accel_noise_mps2", sigma, 0.3),
          .accel_bias = read_constant(section, "accel_bias_mps2", "accel_bias_sigma_mps2", 0.2),
          .range_noise = section.number("range_noise_m", sigma, 5),
          .range_bias = read_constant(section, "range_bias_m", "range_bias_sigma_m", 15),
          .full_errors_beyond = section.number("range_errors_full_beyond_m", Limits::above(0), 1000),
          .closing_speed_noise = section.number("closing_speed_noise_mps", sigma, 3),
          .closing_speed_bias =
              read_constant(section, "closing_speed_bias_mps", "closing_speed_bias_sigma_mps", 5),
          .field_of_view = section.number("field_of_view_deg", Limits::above(0, 37), 8)};
}

}  // namespace

Seeker read_seeker(Section& section) {
  const Limits share = Limits::between(0, 100);
  Seeker node;
  node.schedule = read_schedule(section);
  node.jitter_us = section.time_us("jitter_ms", Limits::between(0, 1000), 0);
  node.errors = read_errors(section);
  node.loss_probability = section.number("loss_percent", share, 0);
  node.invalid_probability = section.number("invalid_percent", share, 0);
  node.invalid_range_probability = section.number("invalid_range_percent", share, 0);
  if (section.has("blackout_s")) {
    const auto [from, to] = section.interval("blackout_s", Limits::at_least(0));
    node.blackout_us = {std::llround(from * 1e6), std::llround(to * 1e6)};
  }
  section.optional("blackout_s");
  section.finish();
  return node;
}

}  // namespace canhil::scenario
