// Properties of the machine, apart from the bus.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"

namespace canhil::doctor {

/// Properties that affect real-time behaviour.
struct Machine {
  std::string preemption;              ///< preemption model of the kernel
  std::string refusal;                 ///< why --realtime is not possible here; empty: it is possible
  std::vector<std::string> governors;  ///< frequency governors of the CPUs
  std::vector<int> cpus;               ///< CPUs available to this process
  std::string isolated;                ///< list of the CPUs isolated from the scheduler
};

/// Lines for kernel, real-time rights, frequency and CPUs.
std::vector<Line> machine_lines(const Machine& machine);

/// The list of CPUs isolated from the scheduler, as the kernel reports it in sysfs.
std::string isolated_cpus();

}  // namespace canhil::doctor
