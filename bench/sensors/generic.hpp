// A sensor of the user's own: each value is an expression over the truth, with errors. The mapping declares
// its values and their units; the scenario says what they are. It needs no C++.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/expression.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/error_stack.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// A value of a generic sensor and its errors, in its SI unit. The lag acts first, then scale, bias and
/// noise, then the other errors of the stack.
struct GenericValue {
  scenario::Expression truth;
  std::optional<scenario::Expression> valid{};  ///< the value is valid where this is not 0; none: always
  world::RandomValue scale_factor{};            ///< error of the scale
  world::RandomValue bias{};
  double noise = 0;  ///< white, 1-sigma of a sample
  world::ErrorStack stack{};
};

/// The settings of a [[sensor]] of kind "generic".
struct GenericSettings {
  scenario::Schedule schedule{};
  std::vector<GenericValue> values;  ///< in the order of the outputs
  SampleLoss loss{};
};

extern const struct Kind generic;

}  // namespace canhil::sensors
