// What this machine grants a process that must be on time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::realtime {

inline constexpr std::string_view cpu_folder = "/sys/devices/system/cpu";

/// How the kernel preempts: "PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT", or "none or voluntary". `version`: of
/// uname().
std::string preemption(std::string_view version);
/// Of the kernel that runs.
std::string preemption();

/// The frequency governors of the given CPUs, each once, in the order of the CPUs; empty where the kernel
/// does not scale the frequency. `folder`: where the kernel shows its CPUs.
std::vector<std::string> governors(const std::vector<int>& cpus,
                                   const std::string& folder = std::string(cpu_folder));

/// True if one of the governors changes the frequency with the load, so that the first work after a pause is
/// done slowly.
bool scales_with_load(const std::vector<std::string>& governors);

/// Numbers as the kernel writes a list of CPUs: 0-3,6.
std::string list(const std::vector<int>& cpus);

/// What a process may do by its limits and capabilities.
struct Rights {
  std::uint64_t priority = 0;      ///< the highest real-time priority that its limit allows
  std::uint64_t locked_bytes = 0;  ///< of memory, by its limit; UINT64_MAX: unlimited
  bool may_schedule = false;       ///< capability CAP_SYS_NICE
  bool may_lock = false;           ///< capability CAP_IPC_LOCK
};

/// Of this process.
Rights rights();

/// Nothing if the rights suffice for the priority with all memory locked; else what is missing and the
/// remedy, in one line. `user` and `program` (a path): for whom the remedy is.
std::string missing(const Rights& rights, int priority, std::string_view user, std::string_view program);

/// The same for this process.
std::string missing_rights(int priority);

}  // namespace canhil::realtime
