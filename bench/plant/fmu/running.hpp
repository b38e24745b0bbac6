// An FMU that was started: in this process, or in one of its own.
#pragma once

#include <chrono>
#include <memory>
#include <span>

#include "bench/plant/fmu/value.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant::fmu {

/// An instance of an FMU after its initialization. The destructor terminates it.
class Running {
 public:
  Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  virtual ~Running() = default;

  /// Advances the FMU from a time [s] by a step [s]. `inputs` and `outputs` have the elements of
  /// Setup::inputs and Setup::outputs one after the other, in the FMU's units. Error, one phrase: the FMU
  /// cannot advance, and is not asked again.
  virtual Result<void> step(double from_s, double step_s, std::span<const double> inputs,
                            std::span<double> outputs) = 0;
};

/// Starts an FMU at time 0 and reads its outputs; error, one phrase.
using Started = Result<std::unique_ptr<Running>>;
/// In this process.
Started start_here(const Setup& setup, std::span<double> outputs);
/// In a process of its own, hil-bench-fmu, which is killed if it does not answer within `patience`.
Started start_apart(const Setup& setup, std::chrono::milliseconds patience, std::span<double> outputs);

/// The number of elements of all variables.
std::size_t elements_of(std::span<const Place> places);

}  // namespace canhil::plant::fmu
