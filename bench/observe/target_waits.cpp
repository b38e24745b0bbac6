#include "bench/observe/target_waits.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace canhil::observe {
namespace {

// The files are read anew at each look, while the run goes on. Therefore this code does not allocate memory:
// a page fault would delay the bench.
using Buffer = std::array<char, 4096>;

// The text of a file of the kernel, or the entries of a folder; empty: it cannot be read.
std::string_view content_of(const char* path, Buffer& buffer, bool folder) {
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  const auto size = folder ? syscall(SYS_getdents64, file, buffer.data(), buffer.size())
                           : read(file, buffer.data(), buffer.size());
  close(file);
  return {buffer.data(), static_cast<std::size_t>(std::max<long>(size, 0))};
}

// Calls take() for each whole number in a text.
template <class Take>
void each_number(std::string_view text, Take take) {
  for (const char *at = text.data(), *const end = at + text.size(); at < end;) {
    std::int64_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error == std::errc{}) take(number);
    at = error == std::errc{} ? next : at + 1;
  }
}

// Calls take() with the id of each thread of a process. A process with more threads than a buffer has entries
// (over a hundred) is looked at in part.
template <class Take>
void each_thread(pid_t process, Take take) {
  std::array<char, 64> path{};
  *fmt::format_to_n(path.data(), path.size() - 1, "/proc/{}/task", process).out = 0;
  Buffer buffer{};
  const std::string_view entries = content_of(path.data(), buffer, true);
  for (std::size_t at = 0; at < entries.size();) {
    dirent64 entry{};
    std::memcpy(&entry, entries.data() + at,
                std::min<std::size_t>(sizeof entry, entries.size() - at));  // entries have various lengths
    if (const int thread = std::atoi(entry.d_name); thread > 0) take(static_cast<pid_t>(thread));
    at += entry.d_reclen;
  }
}

void add_threads_of(pid_t process, std::vector<ThreadTimes>& all) {
  each_thread(process, [&](pid_t thread) {
    std::array<char, 64> path{};
    Buffer buffer{};
    const auto read_file = [&](std::string_view name) {
      *fmt::format_to_n(path.data(), path.size() - 1, "/proc/{}/task/{}/{}", process, thread, name).out = 0;
      return content_of(path.data(), buffer, false);
    };
    ThreadTimes times{.thread = thread};
    int found = 0;
    each_number(read_file("schedstat"), [&](std::int64_t number) {
      if (found == 0) times.run_ns = number;
      if (found == 1) times.wait_ns = number;
      ++found;
    });
    if (found >= 2) all.push_back(times);
    each_number(read_file("children"),
                [&](std::int64_t child) { add_threads_of(static_cast<pid_t>(child), all); });
  });
}

}  // namespace

void read_thread_times(pid_t process, std::vector<ThreadTimes>& times) {
  times.clear();
  add_threads_of(process, times);
}

std::int64_t waited_for_others_ns(std::span<const ThreadTimes> before, std::span<const ThreadTimes> now) {
  const auto since_before = [&](const ThreadTimes& one) {
    const auto earlier = std::ranges::find(before, one.thread, &ThreadTimes::thread);
    const ThreadTimes from = earlier == before.end() ? ThreadTimes{} : *earlier;
    return ThreadTimes{.run_ns = one.run_ns - from.run_ns, .wait_ns = one.wait_ns - from.wait_ns};
  };
  std::int64_t all_ran_ns = 0, longest_ns = 0;
  for (const ThreadTimes& one : now) all_ran_ns += since_before(one).run_ns;
  for (const ThreadTimes& one : now) {
    const ThreadTimes passed = since_before(one);
    longest_ns = std::max(longest_ns, passed.wait_ns - (all_ran_ns - passed.run_ns));
  }
  return longest_ns;
}

checks::Histogram TargetWaits::record() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  return std::move(waits_);
}

void TargetWaits::look(const std::stop_token& stop) {
  using std::chrono::steady_clock;
  const sched_param ordinary{};  // the priority is for the thread that sends
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  waits_.add(std::chrono::nanoseconds(std::chrono::minutes(1)).count(), 0);  // allocates all buckets
  auto then = steady_clock::now();
  constexpr std::size_t usual_threads = 64;
  std::vector<ThreadTimes> before, times;
  before.reserve(usual_threads);
  times.reserve(usual_threads);
  read_thread_times(process_, before);
  while (!stop.stop_requested()) {
    std::this_thread::sleep_until(then + period);
    const auto now = steady_clock::now();
    read_thread_times(process_, times);
    if (!times.empty() && !before.empty()) {
      const std::chrono::nanoseconds waited(waited_for_others_ns(before, times));
      const auto periods = std::max<std::chrono::nanoseconds>(now - then, waited) / period;
      waits_.add(waited.count(), static_cast<std::uint64_t>(std::max<std::int64_t>(periods, 1)));
    }
    then = now;
    before.swap(times);
  }
}

}  // namespace canhil::observe
