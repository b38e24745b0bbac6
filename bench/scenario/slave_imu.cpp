#include "bench/scenario/slave_imu.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

SlaveImu read_slave_imu(Section& section) {
  const Limits sigma = Limits::at_least(0);
  SlaveImu node;
  node.schedule = read_schedule(section);
  node.errors.gyro = {.bias = {.value = section.three("gyro_bias_degph"),
                               .sigma = section.three("gyro_bias_sigma_degph", sigma)},
                      .noise = section.three("gyro_noise_degprth", sigma),
                      .scale_factor = {.value = section.three("gyro_scale_factor_ppm"),
                                       .sigma = section.three("gyro_scale_factor_sigma_ppm", sigma)},
                      .misalignment_sigma = section.number("gyro_misalignment_sigma_mrad", sigma, 0)};
  node.errors.accel = {
      .bias = {.value = section.three("accel_bias_ug"), .sigma = section.three("accel_bias_sigma_ug", sigma)},
      .noise = section.three("accel_noise_ugprthz", sigma),
      .scale_factor = {.value = section.three("accel_scale_factor_ppm"),
                       .sigma = section.three("accel_scale_factor_sigma_ppm", sigma)},
      .misalignment_sigma = section.number("accel_misalignment_sigma_mrad", sigma, 0)};
  node.loss_probability = section.number("loss_percent", Limits::between(0, 100), 0);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
