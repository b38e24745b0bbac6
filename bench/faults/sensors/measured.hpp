// A number of a sensor's samples that a fault changes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/sensors/measurands.hpp"

namespace canhil::faults {

/// A measured quantity, in SI, or what a signal of canhil.dbc carries, in the unit of the signal.
struct Measured {
  const sensors::Kind* sensor = nullptr;
  sensors::Role role = sensors::Role::value;
  std::size_t index = 0;  ///< of the value or flag in the sample
  double factor = 1;      ///< from the unit of this number to SI
  bool turns = false;     ///< an angle, from half a turn below zero to half a turn above
  bool rate = false;      ///< the value of the sample divided by its interval
  std::string name{};     ///< names the random numbers of the fault; the results depend on it

  [[nodiscard]] bool is_time() const {
    return role == sensors::Role::time_of_validity || role == sensors::Role::interval;
  }
  /// `period_us`: of the node; it is the interval of a sample that has none.
  [[nodiscard]] double get(const sensors::Sample& sample, std::int64_t period_us) const;
  void put(sensors::Sample& sample, std::int64_t period_us, double value) const;
};

/// The numbers that a fault changes.
struct OfValues {
  struct Range {
    std::string signal;  ///< "delta_v_x_mps of SlaveImuDeltaV"
    double lowest = 0, highest = 0;
  };
  std::vector<Measured> all{};
  std::vector<Range> ranges{};  ///< of the signals; empty for a quantity
  std::string_view si{};        ///< unit of a quantity; empty: the unit of a signal
  std::string text{};
};

}  // namespace canhil::faults
