#pragma once
// Aiding that arrives late: the last IMU increments with the INS before each, so that a velocity valid at an
// earlier epoch is applied at that epoch, and the increments since are mechanised again with the corrected
// INS. The result is that of a measurement in time, bit for bit.
#include <array>
#include <cstddef>
#include <cstdint>

#include "target/estimators/transfer_alignment/filter.hpp"

namespace canhil::transfer_alignment {

/// Keeps the last `Capacity` increments (about 0.4 kB each). Epochs are the ends of increments, in integer
/// microseconds of the measurements' time base. Every propagate and update of a State goes through its
/// History.
template <std::size_t Capacity>
class History {
 public:
  explicit History(std::int64_t start_us) : now_us_(start_us), last_update_us_(start_us) {}

  /// transfer_alignment::propagate() of an increment that ends at t_us, remembered.
  void propagate(State& state, const strapdown::ImuIncrement& imu, std::int64_t t_us,
                 const Settings& settings) {
    if (count_ == Capacity) {
      first_ = (first_ + 1) % Capacity;
    } else {
      ++count_;
    }
    at(count_ - 1) = {state.ins, imu, now_us_};
    now_us_ = t_us;
    transfer_alignment::propagate(state, imu, settings);
  }

  /// update() of a master velocity [m/s, NED] valid at t_us: at that epoch, or, between two epochs, at the
  /// later one with the INS velocity interpolated linearly to t_us. Refused, with the state untouched:
  /// not_reached, out_of_order (before the last update), older_than_history.
  UpdateResult update(State& state, const Eigen::Vector3d& master_velocity, std::int64_t t_us,
                      const Settings& settings) {
    if (t_us > now_us_) return refused(Outcome::not_reached);
    if (t_us < last_update_us_) return refused(Outcome::out_of_order);
    std::size_t epoch = count_;  // epoch i < count_ is the start of increment i; epoch count_ is now
    while (epoch > 0 && epoch_us(epoch - 1) >= t_us) --epoch;
    const bool between = epoch_us(epoch) != t_us;
    if (between && epoch == 0) return refused(Outcome::older_than_history);

    State then{ins(state, epoch), state.P, state.x};
    Eigen::Vector3d velocity = then.ins.nav.v_eb_n;
    if (between) {
      const double share = static_cast<double>(epoch_us(epoch) - t_us) /
                           static_cast<double>(epoch_us(epoch) - epoch_us(epoch - 1));
      velocity -= share * (velocity - at(epoch - 1).before.nav.v_eb_n);
    }
    UpdateResult result = update_with_difference(then, velocity - master_velocity, settings);
    if (result.outcome != Outcome::ok) return result;
    last_update_us_ = epoch_us(epoch);
    for (std::size_t i = epoch; i < count_; ++i) {
      at(i).before = then.ins;
      transfer_alignment::propagate(then, at(i).imu, settings);
    }
    state = then;
    return result;
  }

 private:
  struct Entry {
    Ins before;
    strapdown::ImuIncrement imu;
    std::int64_t before_us = 0;
  };

  static UpdateResult refused(Outcome outcome) {
    UpdateResult result;
    result.outcome = outcome;
    return result;
  }
  Entry& at(std::size_t i) { return entries_[(first_ + i) % Capacity]; }
  std::int64_t epoch_us(std::size_t i) { return i < count_ ? at(i).before_us : now_us_; }
  const Ins& ins(const State& state, std::size_t epoch) {
    return epoch < count_ ? at(epoch).before : state.ins;
  }

  std::array<Entry, Capacity> entries_;
  std::size_t first_ = 0, count_ = 0;
  std::int64_t now_us_, last_update_us_;
};

}  // namespace canhil::transfer_alignment
