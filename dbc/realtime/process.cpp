#include "dbc/realtime/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "dbc/realtime/host.hpp"

namespace canhil::realtime {
namespace {

constexpr std::size_t page_bytes = 4096;
constexpr std::size_t stack_bytes = 512 << 10;

int cpu_sleep_request = -1;  // remains open until the process ends, because closing it ends the request

// Opens /dev/cpu_dma_latency and writes 0 us. While this file is open, the kernel keeps the CPUs out of sleep
// states from which they wake up late.
void keep_cpus_awake() {
  if (cpu_sleep_request >= 0) return;
  const int file = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  const std::int32_t latency_us = 0;
  if (::write(file, &latency_us, sizeof latency_us) == sizeof latency_us) {
    cpu_sleep_request = file;
  } else {
    ::close(file);
  }
}

void touch(volatile char* bytes, std::size_t size) {
  for (std::size_t at = 0; at < size; at += page_bytes) bytes[at] = 0;
}

// Writes to each page of the stack, so that no page fault occurs later. Not inlined, because the array must
// not stay on the stack of the caller.
[[gnu::noinline]] void touch_stack() {
  std::array<char, stack_bytes> bytes;
  touch(bytes.data(), bytes.size());
}

// Writes to each page of `size` bytes of the heap, so that no page fault occurs later. Also configures
// malloc(): it never returns freed memory to the kernel, and it takes large blocks from the heap too.
void touch_heap(std::size_t size) {
  ::mallopt(M_TRIM_THRESHOLD, -1);
  ::mallopt(M_MMAP_MAX, 0);
  if (void* bytes = std::malloc(size); bytes != nullptr) {
    touch(static_cast<char*>(bytes), size);
    std::free(bytes);
  }
}

tl::unexpected<Error> refused(const std::string& what) {
  return failure(
      fmt::format("--realtime: {}: {}; expected a kernel, container or control group that allows it", what,
                  std::strerror(errno)));
}

std::string name_of(int policy) {
  switch (policy & ~SCHED_RESET_ON_FORK) {
    case SCHED_FIFO:
      return "SCHED_FIFO";
    case SCHED_RR:
      return "SCHED_RR";
    case SCHED_BATCH:
      return "SCHED_BATCH";
    case SCHED_IDLE:
      return "SCHED_IDLE";
    default:
      return "SCHED_OTHER";
  }
}

std::int64_t locked_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::int64_t kib = 0;
    if (word == "VmLck:" && status >> kib) return kib;
  }
  return 0;
}

}  // namespace

Result<void> enter(const Request& request) {
  if (auto lacking = missing_rights(request.priority); !lacking.empty())
    return failure("--realtime: " + std::move(lacking));
  if (request.cpu) {
    if (auto known = check_cpu("--cpu", *request.cpu); !known) return known;
  }
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) return refused("memory cannot be locked");
  touch_stack();
  touch_heap(request.heap_bytes);
  ::prctl(PR_SET_TIMERSLACK, 1UL);
  keep_cpus_awake();
  if (request.cpu && !pin({*request.cpu}))
    return refused(fmt::format("CPU {} cannot be taken", *request.cpu));
  const sched_param parameters{.sched_priority = request.priority};
  if (::sched_setscheduler(0, SCHED_FIFO, &parameters) != 0)
    return refused(fmt::format("SCHED_FIFO with priority {}", request.priority));
  return {};
}

// After fork(), parent and child share pages until one of them writes. mlockall() copies these pages, as a
// write would.
bool own_memory_again() { return ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0; }

std::vector<int> cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> found;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return found;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) found.push_back(cpu);
  }
  return found;
}

Result<void> check_cpu(const std::string& option, int cpu) {
  const std::vector<int> mine = cpus();
  if (std::ranges::find(mine, cpu) != mine.end()) return {};
  return failure(
      fmt::format("{} {}: this process may not run there, expected one of {}", option, cpu, list(mine)));
}

bool pin(const std::vector<int>& cpus) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : cpus) CPU_SET(static_cast<std::size_t>(cpu), &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

Standing standing() {
  sched_param parameters{};
  ::sched_getparam(0, &parameters);
  std::vector<int> mine = cpus();
  std::vector<std::string> scaling = governors(mine);
  return {.policy = name_of(::sched_getscheduler(0)),
          .priority = parameters.sched_priority,
          .cpus = std::move(mine),
          .locked_kib = locked_kib(),
          .timer_slack_ns = ::prctl(PR_GET_TIMERSLACK),
          .awake = cpu_sleep_request >= 0,
          .governors = std::move(scaling),
          .preemption = preemption()};
}

std::string to_text(const Standing& standing) {
  return fmt::format(
      "{}{}, CPU {}, {} MiB locked, timer slack {} ns, {}{}, {}", standing.policy,
      standing.priority > 0 ? fmt::format(" {}", standing.priority) : "", list(standing.cpus),
      standing.locked_kib / 1024, standing.timer_slack_ns, standing.awake ? "no deep sleep, " : "",
      standing.governors.empty() ? "no frequency scaling"
                                 : fmt::format("governor {}", fmt::join(standing.governors, ", ")),
      standing.preemption);
}

std::string frequency_warning(const Standing& standing) {
  if (!scales_with_load(standing.governors)) return "";
  return fmt::format(
      "warning: the frequency of CPU {} follows the load (governor {}); `sudo cpupower frequency-set -g "
      "performance` ends that",
      list(standing.cpus), fmt::join(standing.governors, ", "));
}

}  // namespace canhil::realtime
