// The properties of this machine that matter in real time: the preemption model of the kernel, the frequency
// governors, and the rights of the process.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::realtime {

inline constexpr std::string_view cpu_folder = "/sys/devices/system/cpu";

/// The preemption model of a kernel: "PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT_LAZY", "PREEMPT", or "none or
/// voluntary". `version` is the field `version` of uname().
std::string preemption(std::string_view version);
/// The preemption model of the running kernel.
std::string preemption();

/// The frequency governors of the given CPUs, each once, in the order of the CPUs. The list is empty if the
/// kernel does not scale the frequency. `folder` is the directory in which the kernel describes the CPUs.
std::vector<std::string> governors(const std::vector<int>& cpus,
                                   const std::string& folder = std::string(cpu_folder));

/// True if one of the governors changes the frequency with the load. With such a governor, a CPU is slow
/// after a pause.
bool scales_with_load(const std::vector<std::string>& governors);

/// The CPU numbers in the list format of the kernel, such as "0-3,6".
std::string list(const std::vector<int>& cpus);

/// The rights for real time that a process has by its limits and capabilities.
struct Rights {
  std::uint64_t priority = 0;      ///< the highest real-time priority that the process's limit allows
  std::uint64_t locked_bytes = 0;  ///< how much memory the process may lock; UINT64_MAX: no limit
  bool may_schedule = false;       ///< the process has the capability CAP_SYS_NICE
  bool may_lock = false;           ///< the process has the capability CAP_IPC_LOCK
};

/// The rights of this process.
Rights rights();

/// Returns an empty string if the rights allow this priority and allow the process to lock all memory.
/// Otherwise returns one line with the missing rights and the remedy, in which `user` and `program` (a path)
/// appear.
std::string missing(const Rights& rights, int priority, std::string_view user, std::string_view program);

/// Calls missing() for this process.
std::string missing_rights(int priority);

}  // namespace canhil::realtime
