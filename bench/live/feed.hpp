// A queue from the flight's thread to the view's thread. It never blocks the flight.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bench/drive/onlooker.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::live {

/// One call of a function of an observer, stored as a value.
struct Event {
  enum class Kind : std::uint8_t { transmitted, received, foreign, time_set, interface_changed };
  Kind kind = Kind::transmitted;
  bool up = false;
  std::int64_t t_ns = 0, late_ns = 0;
  Received received{};  ///< for `transmitted`, only the frame is set
};

/// One thread writes, another thread reads. Writing does not wait, allocate or make a system call; an event
/// that does not fit is dropped and counted.
class Feed final : public observe::Observer {
 public:
  static constexpr std::size_t frames = 32'768;   // 4 MiB; more than ten seconds of a full bus of 1 Mbit/s
  static constexpr std::size_t values = 262'144;  // 2 MiB of the plants' outputs

  explicit Feed(std::size_t room = frames) : events_(room), values_(values) {}

  /// Sets the records to which the flight adds rows; the feed copies these rows. Must be called before the
  /// first frame.
  void follow(world::PlantRecords plants) {
    plants_ = std::move(plants);
    followed_.assign(plants_.size(), 0);
  }

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override {
    put({.kind = Event::Kind::received, .received = received});
  }
  void foreign(const Received& received) override {
    put({.kind = Event::Kind::foreign, .received = received});
  }
  void time_set(std::int64_t t_ns) override { put({.kind = Event::Kind::time_set, .t_ns = t_ns}); }
  void interface_changed(bool up, std::int64_t t_ns) override {
    put({.kind = Event::Kind::interface_changed, .up = up, .t_ns = t_ns});
  }

  /// Removes the events that are now in the queue, passes them to `to` in order, and then adds the new rows
  /// of the plants to their copies, in the order of follow(). A row is queued before its frames, so no row is
  /// missing. Returns the number of events.
  std::uint64_t drain(observe::Observer& to, std::span<world::PlantRecord> copies);

  [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  void put(const Event& event) {
    if (!events_.push(event)) drop();
  }
  void drop() { dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }

  boost::lockfree::spsc_queue<Event> events_;
  boost::lockfree::spsc_queue<double>
      values_;  // rows: plant, number of outputs, time [us], whether it ended, outputs
  std::atomic<std::uint64_t> dropped_ = 0;
  world::PlantRecords plants_;
  std::vector<std::size_t> followed_;  // for each plant: number of rows that were queued
  std::vector<double> row_;
};

}  // namespace canhil::live
