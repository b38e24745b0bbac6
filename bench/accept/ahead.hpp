// Results that several threads compute ahead, given out in order.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace canhil::accept {

/// Works on tasks ahead of the caller, each as soon as a thread is free.
template <class Task, class Result>
class Ahead {
 public:
  /// `stop` becomes true if the result is not wanted any more.
  using Work = std::function<Result(const Task& task, const std::atomic<bool>& stop)>;

  /// `work` is called from `threads` threads at the same time (0: one per core). The tasks must outlive this
  /// object.
  Ahead(std::vector<const Task*> tasks, unsigned threads, Work work, const std::atomic<bool>& stop)
      : tasks_(std::move(tasks)), work_(std::move(work)), stop_(stop), results_(tasks_.size()) {
    const std::size_t wanted = threads > 0 ? threads : std::max(std::thread::hardware_concurrency(), 1U);
    for (std::size_t i = 0; i < std::min(wanted, tasks_.size()); ++i)
      threads_.emplace_back([this] { run(); });
  }
  /// Stops the tasks that were begun and not taken, and waits for their end.
  ~Ahead() {
    begun_ = tasks_.size();
    ended_ = true;
  }
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  /// Waits for the next result, in the order of the tasks, and returns it.
  Result next() {
    constexpr std::chrono::milliseconds look_period(50);  // a signal sets stop_, and wakes nobody
    std::unique_lock lock(mutex_);
    std::optional<Result>& wanted = results_.at(taken_++);
    while (!arrived_.wait_for(lock, look_period, [&] { return wanted.has_value(); })) {
      if (stop_) ended_ = true;
    }
    Result result = std::move(*wanted);
    wanted.reset();
    return result;
  }

 private:
  void run() {
    for (;;) {
      const std::size_t at = begun_++;
      if (at >= tasks_.size()) return;
      Result result = work_(*tasks_[at], ended_);
      const std::lock_guard lock(mutex_);
      results_[at] = std::move(result);
      arrived_.notify_all();
    }
  }

  std::vector<const Task*> tasks_;
  Work work_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> ended_ = false;  // what the work sees of stop_, and of the destructor
  std::mutex mutex_;                 // guards results_
  std::condition_variable arrived_;
  std::vector<std::optional<Result>> results_;
  std::size_t taken_ = 0;
  std::atomic<std::size_t> begun_ = 0;
  std::vector<std::jthread> threads_;  // the last member: it ends first
};

}  // namespace canhil::accept
