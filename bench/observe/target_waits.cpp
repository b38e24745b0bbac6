#include "bench/observe/target_waits.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace canhil::observe {
namespace {

// The whole numbers in a file of the kernel. The file is read anew at each look, so streams would be too
// slow.
std::vector<std::int64_t> numbers_in(const char* path) {
  std::vector<std::int64_t> numbers;
  std::array<char, 4096> text{};
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return numbers;
  const ssize_t size = read(file, text.data(), text.size());
  close(file);
  const char* const end = text.data() + std::max<ssize_t>(size, 0);
  for (const char* at = text.data(); at < end;) {
    std::int64_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error == std::errc{}) numbers.push_back(number);
    at = error == std::errc{} ? next : at + 1;
  }
  return numbers;
}

void add_threads_of(pid_t process, std::vector<ThreadTimes>& all) {
  DIR* threads = opendir(fmt::format("/proc/{}/task", process).c_str());
  if (threads == nullptr) return;
  std::vector<pid_t> children;
  while (const dirent* entry = readdir(threads)) {
    const int thread = std::atoi(entry->d_name);
    if (thread == 0) continue;  // . and ..
    const auto path = [&](std::string_view name) {
      return fmt::format("/proc/{}/task/{}/{}", process, thread, name);
    };
    if (const auto times = numbers_in(path("schedstat").c_str()); times.size() >= 2)
      all.push_back({.thread = thread, .run_ns = times[0], .wait_ns = times[1]});
    for (const std::int64_t child : numbers_in(path("children").c_str()))
      children.push_back(static_cast<pid_t>(child));
  }
  closedir(threads);
  for (const pid_t child : children) add_threads_of(child, all);
}

}  // namespace

std::vector<ThreadTimes> thread_times(pid_t process) {
  std::vector<ThreadTimes> all;
  add_threads_of(process, all);
  return all;
}

std::int64_t waited_for_others_ns(std::span<const ThreadTimes> before, std::span<const ThreadTimes> now) {
  std::vector<ThreadTimes> passed;
  std::int64_t all_ran_ns = 0;
  for (const ThreadTimes& one : now) {
    const auto earlier = std::ranges::find(before, one.thread, &ThreadTimes::thread);
    const ThreadTimes from = earlier == before.end() ? ThreadTimes{} : *earlier;
    passed.push_back({.run_ns = one.run_ns - from.run_ns, .wait_ns = one.wait_ns - from.wait_ns});
    all_ran_ns += passed.back().run_ns;
  }
  std::int64_t longest_ns = 0;
  for (const ThreadTimes& one : passed)
    longest_ns = std::max(longest_ns, one.wait_ns - (all_ran_ns - one.run_ns));
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
  auto then = steady_clock::now();
  std::vector<ThreadTimes> before = thread_times(process_);
  while (!stop.stop_requested()) {
    std::this_thread::sleep_until(then + period);
    const auto now = steady_clock::now();
    std::vector<ThreadTimes> times = thread_times(process_);
    if (!times.empty() && !before.empty()) {
      const std::chrono::nanoseconds waited(waited_for_others_ns(before, times));
      const auto periods = std::max<std::chrono::nanoseconds>(now - then, waited) / period;
      waits_.add(waited.count(), static_cast<std::uint64_t>(std::max<std::int64_t>(periods, 1)));
    }
    then = now;
    before = std::move(times);
  }
}

}  // namespace canhil::observe
