// The real-time properties of this machine: kernel preemption, frequency governors, rights of the process.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::realtime {

inline constexpr std::string_view cpu_folder = "/sys/devices/system/cpu";

/// The kernel's preemption model: "PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT_LAZY", "PREEMPT", or "none or
/// voluntary". `version`: the version that uname() returns.
std::string preemption(std::string_view version);
/// The preemption model of the running kernel.
std::string preemption();

/// The different frequency governors of the given CPUs, in the order of the CPUs; empty if the kernel does
/// not scale the frequency. `folder`: the kernel's directory of CPUs.
std::vector<std::string> governors(const std::vector<int>& cpus,
                                   const std::string& folder = std::string(cpu_folder));

/// True if one of the governors changes the frequency with the load, which slows the first work after a
/// pause.
bool scales_with_load(const std::vector<std::string>& governors);

/// CPU numbers in the kernel's list format: 0-3,6.
std::string list(const std::vector<int>& cpus);

/// The real-time rights of a process, by its limits and capabilities.
struct Rights {
  std::uint64_t priority = 0;      ///< the highest real-time priority that its limit allows
  std::uint64_t locked_bytes = 0;  ///< memory that its limit allows to lock; UINT64_MAX: unlimited
  bool may_schedule = false;       ///< capability CAP_SYS_NICE
  bool may_lock = false;           ///< capability CAP_IPC_LOCK
};

/// The rights of this process.
Rights rights();

/// Empty if the rights suffice for the priority with all memory locked; else one line with the missing rights
/// and the remedy. `user` and `program` (a path) appear in the remedy.
std::string missing(const Rights& rights, int priority, std::string_view user, std::string_view program);

/// missing() for this process.
std::string missing_rights(int priority);

}  // namespace canhil::realtime
