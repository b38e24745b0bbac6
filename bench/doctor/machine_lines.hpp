// Properties of the machine on which the bench runs; the bus is not part of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"

namespace canhil::doctor {

/// Properties that affect real-time behaviour.
struct Machine {
  std::string preemption;  ///< preemption model of the kernel
  std::string refusal;     ///< why --realtime is not possible on this machine; empty: --realtime is possible
  std::vector<std::string> governors;  ///< frequency governors of the CPUs
  std::vector<int> cpus;               ///< CPUs available to this process
  std::string isolated;                ///< list of the CPUs that are isolated from the scheduler
};

/// One line each for the kernel, the rights for real time, the CPU frequency and the CPUs.
std::vector<Line> machine_lines(const Machine& machine);

/// The list of the CPUs that are isolated from the scheduler, in the format in which sysfs has this list.
std::string isolated_cpus();

}  // namespace canhil::doctor
