#include "bench/sensors/error_stack.hpp"

#include <fmt/format.h>

#include <string>

namespace canhil::sensors {
namespace {

using scenario::Limits;
using scenario::Section;
using world::ErrorStack;
using world::Vector3;

// The same number, at least 0, for all axes; 0 without the key.
double read_one(Section& section, std::string_view key, const std::string& meaning) {
  return key.empty() ? 0 : section.number({key, meaning}, Limits::at_least(0), 0);
}
Vector3 read_three(Section& section, std::string_view key, const std::string& meaning) {
  return key.empty() ? Vector3::Zero() : section.three({key, meaning}, Limits::at_least(0));
}

}  // namespace

std::int64_t read_order(Section& section, std::string_view order, std::string_view bandwidth) {
  const std::string meaning = fmt::format("Order of the lag of `{}`: 1, or 2 (Butterworth).", bandwidth);
  const std::int64_t value = section.optional_integer({order, meaning}, 1).value_or(1);
  if (value > 2) section.reject(order, fmt::format("is {}", value), "1 or 2");
  return value;
}

world::TriadErrors::Stacks read_error_stacks(Section& section, const StackKeys& keys) {
  ErrorStack common;
  common.bandwidth = read_one(
      section, keys.bandwidth,
      fmt::format("Bandwidth of {} (-3 dB): a lag of the true value, not of the noise; 0: none.", keys.of));
  if (!keys.order.empty()) common.order = read_order(section, keys.order, keys.bandwidth);
  const Vector3 correlated = read_three(
      section, keys.correlated,
      fmt::format("1-sigma of an error of {} that is correlated in time (Gauss-Markov).", keys.of));
  const Vector3 instability = read_three(
      section, keys.instability,
      fmt::format("Bias instability of {}: the largest Allan deviation of an error that is correlated in "
                  "time (Gauss-Markov), at 1.89 correlation times.",
                  keys.of));
  if (!keys.correlation.empty()) {
    const std::string meaning = fmt::format("Correlation time of `{}{}`.", keys.correlated, keys.instability);
    common.correlation_s =
        section.number({keys.correlation, meaning}, Limits::above(0), common.correlation_s);
  }
  const Vector3 walk = read_three(section, keys.walk, fmt::format("Random walk of the bias of {}.", keys.of));
  if (!keys.range.empty()) {
    const std::string meaning =
        fmt::format("Range of {}: larger values saturate. Default: no limit.", keys.of);
    const auto range = section.optional_number({keys.range, meaning}, Limits::above(0));
    common.highest = range.value_or(ErrorStack::unlimited);
    common.lowest = -common.highest;
  }
  common.step = read_one(section, keys.step, fmt::format("Step of the output of {}; 0: none.", keys.of));
  common.pulse = read_one(
      section, keys.pulse,
      fmt::format("Increment that a count of {} stands for; what does not fill a count is in the next "
                  "sample. 0: none.",
                  keys.of));
  world::TriadErrors::Stacks stacks;
  for (int axis = 0; axis < 3; ++axis) {
    ErrorStack& stack = stacks[static_cast<std::size_t>(axis)];
    stack = common;
    stack.correlated = correlated[axis] + instability[axis] / world::gauss_markov_peak;
    stack.random_walk = walk[axis];
  }
  return stacks;
}

}  // namespace canhil::sensors
