// The flights of a suite, flown on several threads and given out in order.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "bench/accept/accept.hpp"
#include "bench/accept/profile.hpp"

namespace canhil::accept {

/// What one flight brought: the results of its own checks, and its answers, for flights that are compared
/// with it.
struct Flown {
  Result<std::vector<Item>> items;
  std::unique_ptr<Answers> answers = std::make_unique<Answers>();
};

/// Flies flights ahead of their judgement, each as soon as a thread is free.
class FlownAhead {
 public:
  using Fly = std::function<Flown(const Flight& flight, const std::atomic<bool>& stop)>;

  /// `fly` is called from `threads` threads at the same time (0: one per core).
  FlownAhead(std::vector<const Flight*> flights, unsigned threads, Fly fly, const std::atomic<bool>& stop);
  /// Ends the flights that were begun and not taken.
  ~FlownAhead();
  FlownAhead(const FlownAhead&) = delete;
  FlownAhead& operator=(const FlownAhead&) = delete;

  /// Waits for the next flight, in the order of the constructor, and returns it.
  Flown next();

 private:
  void work();

  std::vector<const Flight*> flights_;
  Fly fly_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> ended_ = false;  ///< what the flights see of stop_, and of the destructor
  std::mutex mutex_;                 // guards flown_
  std::condition_variable arrived_;
  std::vector<std::optional<Flown>> flown_;
  std::size_t taken_ = 0;
  std::atomic<std::size_t> begun_ = 0;
  std::vector<std::jthread> threads_;
};

}  // namespace canhil::accept
