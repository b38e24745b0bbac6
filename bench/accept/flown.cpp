#include "bench/accept/flown.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace canhil::accept {

FlownAhead::FlownAhead(std::vector<const Flight*> flights, unsigned threads, Fly fly,
                       const std::atomic<bool>& stop)
    : flights_(std::move(flights)), fly_(std::move(fly)), stop_(stop), flown_(flights_.size()) {
  const std::size_t cores = threads > 0 ? threads : std::max(std::thread::hardware_concurrency(), 1U);
  for (std::size_t i = 0; i < std::min(cores, flights_.size()); ++i)
    threads_.emplace_back([this] { work(); });
}

FlownAhead::~FlownAhead() {
  begun_ = flights_.size();
  ended_ = true;
}

Flown FlownAhead::next() {
  constexpr std::chrono::milliseconds look_period(50);  // a signal sets stop_, and wakes nobody
  std::unique_lock lock(mutex_);
  std::optional<Flown>& wanted = flown_.at(taken_++);
  while (!arrived_.wait_for(lock, look_period, [&] { return wanted.has_value(); })) {
    if (stop_) ended_ = true;
  }
  Flown flown = std::move(*wanted);
  wanted.reset();
  return flown;
}

void FlownAhead::work() {
  for (;;) {
    const std::size_t at = begun_++;
    if (at >= flights_.size()) return;
    Flown flown = fly_(*flights_[at], ended_);
    const std::lock_guard lock(mutex_);
    flown_[at] = std::move(flown);
    arrived_.notify_all();
  }
}

}  // namespace canhil::accept
