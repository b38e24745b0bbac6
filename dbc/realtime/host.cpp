#include "dbc/realtime/host.hpp"

#include <fmt/format.h>
#include <linux/capability.h>
#include <pwd.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

namespace canhil::realtime {
namespace {

// The limit of a resource. rlim_t has 64 bits, and RLIM_INFINITY is its largest value.
std::uint64_t limit(int resource) {
  rlimit value{};
  return ::getrlimit(static_cast<__rlimit_resource>(resource), &value) == 0 ? value.rlim_cur : 0;
}

bool is_capable(int capability) {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  if (::syscall(SYS_capget, &header, sets.data()) != 0) return false;
  return (sets.at(CAP_TO_INDEX(capability)).effective & CAP_TO_MASK(static_cast<unsigned>(capability))) != 0;
}

std::string user_name() {
  const passwd* entry = ::getpwuid(::geteuid());
  return entry != nullptr ? entry->pw_name : fmt::format("#{}", ::geteuid());
}

std::string program_path() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).string();
}

}  // namespace

std::string preemption(std::string_view version) {
  // Examples of `version`: "#1 SMP PREEMPT_RT Debian ..."; before Linux 5.3 "#1 SMP PREEMPT RT".
  for (const std::string_view model :
       {"PREEMPT_RT", "PREEMPT RT", "PREEMPT_DYNAMIC", "PREEMPT_LAZY", "PREEMPT"}) {
    if (version.find(model) != std::string_view::npos)
      return model == "PREEMPT RT" ? "PREEMPT_RT" : std::string(model);
  }
  return "none or voluntary";
}

std::string preemption() {
  utsname name{};
  return ::uname(&name) == 0 ? preemption(name.version) : preemption("");
}

std::vector<std::string> governors(const std::vector<int>& cpus, const std::string& folder) {
  std::vector<std::string> found;
  for (const int cpu : cpus) {
    std::ifstream file(fmt::format("{}/cpu{}/cpufreq/scaling_governor", folder, cpu));
    std::string governor;
    if (file >> governor && std::ranges::find(found, governor) == found.end()) found.push_back(governor);
  }
  return found;
}

bool scales_with_load(const std::vector<std::string>& governors) {
  return std::ranges::any_of(governors, [](const std::string& governor) {
    return governor != "performance" && governor != "userspace";
  });
}

std::string list(const std::vector<int>& cpus) {
  std::vector<std::string> runs;
  for (std::size_t first = 0; first < cpus.size();) {
    std::size_t last = first;
    while (last + 1 < cpus.size() && cpus[last + 1] == cpus[last] + 1) ++last;
    runs.push_back(first == last ? fmt::format("{}", cpus[first])
                                 : fmt::format("{}-{}", cpus[first], cpus[last]));
    first = last + 1;
  }
  return fmt::format("{}", fmt::join(runs, ","));
}

Rights rights() {
  return {.priority = limit(RLIMIT_RTPRIO),
          .locked_bytes = limit(RLIMIT_MEMLOCK),
          .may_schedule = is_capable(CAP_SYS_NICE),
          .may_lock = is_capable(CAP_IPC_LOCK)};
}

std::string missing(const Rights& rights, int priority, std::string_view user, std::string_view program) {
  std::vector<std::string> lacks;
  if (!rights.may_schedule && rights.priority < static_cast<std::uint64_t>(priority))
    lacks.push_back(fmt::format("real-time priority {} is above the limit of {}", priority, rights.priority));
  // With a finite limit, the right counts as missing: the limit may suffice at the start, but locking fails
  // later, when the program needs more memory.
  if (!rights.may_lock && rights.locked_bytes != std::numeric_limits<std::uint64_t>::max())
    lacks.push_back(
        fmt::format("the limit of {} KiB does not allow locking all memory", rights.locked_bytes / 1024));
  if (lacks.empty()) return "";
  return fmt::format(
      "{}: add the lines '{} - rtprio {}' and '{} - memlock unlimited' to "
      "/etc/security/limits.d/canhil.conf and log in again, or `sudo setcap cap_sys_nice,cap_ipc_lock+ep {}`",
      fmt::join(lacks, " and "), user, priority, user, program);
}

std::string missing_rights(int priority) { return missing(rights(), priority, user_name(), program_path()); }

}  // namespace canhil::realtime
