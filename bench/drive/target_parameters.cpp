#include "bench/drive/target_parameters.hpp"

#include "messages/canhil.hpp"
#include "target/device/adapters.hpp"

namespace canhil::drive {

std::vector<ParametersOf> target_parameters() {
  std::vector<ParametersOf> all;
  for (const auto& adapter : target::make_adapters()) {
    ParametersOf of{.estimator = name_of(adapter->estimator()), .parameters = {}};
    for (const messages::Parameter parameter : messages::enumerators<messages::Parameter>) {
      if (const auto range = adapter->range(parameter))
        of.parameters.push_back({.name = name_of(parameter),
                                 .initial = range->initial,
                                 .minimum = range->minimum,
                                 .maximum = range->maximum,
                                 .whole = range->whole,
                                 .while_running = range->while_running,
                                 .meaning = range->meaning});
    }
    all.push_back(std::move(of));
  }
  return all;
}

}  // namespace canhil::drive
