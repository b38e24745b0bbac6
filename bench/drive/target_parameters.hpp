// The parameters of hil-target. `hil-bench reference` lists them on a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace canhil::drive {

struct TargetParameter {
  std::string_view name;
  double initial = 0, minimum = 0, maximum = 0;  ///< in the unit at the end of `name`
  bool whole = false, while_running = false;
  std::string_view meaning;
};

struct ParametersOf {
  std::string_view estimator;
  std::vector<TargetParameter> parameters;
};

/// Reads the parameter tables of a Device.
std::vector<ParametersOf> target_parameters();

}  // namespace canhil::drive
