#include "bench/faults/sensors/measured.hpp"

#include <cmath>
#include <numbers>

namespace canhil::faults {
namespace {

using sensors::Role;
using sensors::Sample;

double interval_s(const Sample& sample, std::int64_t period_us) {
  return 1e-6 * (sample.interval_us > 0 ? sample.interval_us : static_cast<double>(period_us));
}

}  // namespace

double Measured::get(const Sample& sample, std::int64_t period_us) const {
  switch (role) {
    case Role::time_of_validity:
      return static_cast<double>(sample.stamp_us);
    case Role::interval:
      return sample.interval_us;
    case Role::validity:
      return (sample.invalid >> index & 1U) != 0 ? 0 : 1;
    case Role::value:
      break;
  }
  double value = sample.values[index];
  if (turns && std::abs(value) > std::numbers::pi) value = std::remainder(value, 2 * std::numbers::pi);
  return value / factor / (rate ? interval_s(sample, period_us) : 1);
}

void Measured::put(Sample& sample, std::int64_t period_us, double value) const {
  switch (role) {
    case Role::time_of_validity:
      sample.stamp_us = std::llround(value);
      break;
    case Role::interval:
      sample.interval_us = value;
      break;
    case Role::validity:
      sample.invalid = value == 0 ? sample.invalid | 1U << index : sample.invalid & ~(1U << index);
      break;
    case Role::value:
      sample.values[index] = value * factor * (rate ? interval_s(sample, period_us) : 1);
      break;
  }
}

}  // namespace canhil::faults
