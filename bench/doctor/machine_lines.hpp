// Properties of the machine, apart from the bus.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"

namespace canhil::doctor {

/// What the machine offers.
struct Machine {
  std::string preemption;              ///< preemption model of the kernel
  std::string refusal;                 ///< why --realtime is not possible here; empty: it is
  std::vector<std::string> governors;  ///< of the CPUs
  std::vector<int> cpus;               ///< available to this process
  std::string isolated;                ///< list of the CPUs excluded from scheduling
};

/// Lines for kernel, real-time rights, frequency and CPUs.
std::vector<Line> machine_lines(const Machine& machine);

/// The list from the kernel's command line.
std::string isolated_cpus();

}  // namespace canhil::doctor
