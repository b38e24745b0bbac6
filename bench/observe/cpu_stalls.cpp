#include "bench/observe/cpu_stalls.hpp"

#include <sched.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "dbc/realtime/wake_ups.hpp"

namespace canhil::observe {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::minutes longest{1};  // a delay beyond all buckets of a histogram

// The memory of the bench may be locked, so each stack takes real memory.
constexpr std::size_t stack_bytes = 128 * 1024;

// The attributes of a thread on one CPU, with the priority of the probes.
struct Attributes {
  explicit Attributes(std::size_t cpu) {
    pthread_attr_init(&of_thread);
    pthread_attr_setstacksize(&of_thread, stack_bytes);
    cpu_set_t only{};
    CPU_SET(cpu, &only);
    pthread_attr_setaffinity_np(&of_thread, sizeof only, &only);
    pthread_attr_setinheritsched(&of_thread, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&of_thread, SCHED_FIFO);
    const sched_param parameters{.sched_priority = CpuStalls::priority};
    pthread_attr_setschedparam(&of_thread, &parameters);
  }
  ~Attributes() { pthread_attr_destroy(&of_thread); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  pthread_attr_t of_thread{};
};

}  // namespace

CpuStalls::CpuStalls(pid_t process) {
  cpu_set_t cpus{};
  if (sched_getaffinity(process, sizeof cpus, &cpus) != 0) return;
  for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &cpus)) continue;
    auto probe = std::make_unique<Probe>(Probe{.stop = &stop_});
    probe->delays.add(nanoseconds(longest).count(),
                      0);  // allocates all buckets: the thread allocates nothing
    const Attributes attributes(cpu);
    if (pthread_create(&probe->thread, &attributes.of_thread, watch, probe.get()) != 0) continue;
    probes_.push_back(std::move(probe));
  }
}

CpuStalls::~CpuStalls() { end(); }

void* CpuStalls::watch(void* probe) {
  Probe& own = *static_cast<Probe*>(probe);
  realtime::wake_each(
      nanoseconds(period).count(), [&](std::int64_t /*due_ns*/) { return !*own.stop; },
      [&](std::int64_t late_ns) { own.delays.add(late_ns); });
  return nullptr;
}

void CpuStalls::end() {
  stop_ = true;
  for (const auto& probe : probes_) pthread_join(probe->thread, nullptr);
}

checks::Histogram CpuStalls::record() {
  end();
  checks::Histogram all;
  for (const auto& probe : probes_) all.add(probe->delays);
  probes_.clear();
  return all;
}

}  // namespace canhil::observe
