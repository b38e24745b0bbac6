#include "bench/drive/target_parameters.hpp"

#include "messages/canhil.hpp"
#include "target/device/device.hpp"

namespace canhil::drive {

std::vector<ParametersOf> target_parameters() {
  std::vector<ParametersOf> all;
  const target::Device device;
  for (const messages::Estimator estimator : messages::enumerators<messages::Estimator>) {
    ParametersOf of{.estimator = name_of(estimator), .parameters = {}};
    for (const messages::Parameter parameter : messages::enumerators<messages::Parameter>) {
      if (const auto range = device.range(estimator, parameter))
        of.parameters.push_back({.name = name_of(parameter),
                                 .initial = range->initial,
                                 .minimum = range->minimum,
                                 .maximum = range->maximum,
                                 .whole = range->whole,
                                 .while_running = range->while_running,
                                 .meaning = range->meaning});
    }
    if (!of.parameters.empty()) all.push_back(std::move(of));
  }
  return all;
}

}  // namespace canhil::drive
