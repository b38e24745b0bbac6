// The registry of the target's estimators.
#pragma once

#include <memory>
#include <vector>

#include "target/device/adapter.hpp"

namespace canhil::target {

std::unique_ptr<Adapter> make_transfer_alignment_adapter();
std::unique_ptr<Adapter> make_inflight_alignment_adapter();
std::unique_ptr<Adapter> make_los_rate_adapter();
std::unique_ptr<Adapter> make_wind_adapter();

/// One adapter of each estimator. Add new estimators here.
inline std::vector<std::unique_ptr<Adapter>> make_adapters() {
  std::vector<std::unique_ptr<Adapter>> adapters;
  adapters.push_back(make_transfer_alignment_adapter());
  adapters.push_back(make_inflight_alignment_adapter());
  adapters.push_back(make_los_rate_adapter());
  adapters.push_back(make_wind_adapter());
  return adapters;
}

}  // namespace canhil::target
