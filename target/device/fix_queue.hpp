// A queue of fixes whose time of validity is after the newest IMU epoch. The queue keeps each fix until the
// INS reaches the fix's time of validity.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "target/device/adapter.hpp"

namespace canhil::target {

/// A value from the bus with its time of validity and its counter.
template <class Value>
struct At {
  std::int64_t t_us = 0;
  std::uint8_t counter = 0;
  Value value{};
};

template <class Value, std::size_t capacity>
class FixQueue {
 public:
  void clear() { count_ = 0; }

  /// Appends a fix; false: no room.
  bool push(const At<Value>& fix) {
    if (count_ == capacity) return false;
    waiting_[count_++] = fix;
    return true;
  }

  /// Calls update(fix), in order, for each fix whose time of validity the INS has reached, and removes the
  /// fix. Stops after a call that returns a fault.
  template <class Update>
  Health reached(std::int64_t ins_us, const Update& update) {
    std::size_t done = 0;
    Health health = Health::good;
    while (done < count_ && waiting_[done].t_us <= ins_us && health == Health::good)
      health = update(waiting_[done++]);
    if (done == 0) return health;
    std::move(waiting_.begin() + static_cast<std::ptrdiff_t>(done),
              waiting_.begin() + static_cast<std::ptrdiff_t>(count_), waiting_.begin());
    count_ -= done;
    return health;
  }

 private:
  std::array<At<Value>, capacity> waiting_{};
  std::size_t count_ = 0;
};

}  // namespace canhil::target
