// What the process around the device has to say of the bus, which no frame can carry.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/ports/bus_errors.hpp"
#include "dbc/ports/fd_groups.hpp"

namespace canhil::target {

/// Counts on the frame path, without a word; told from time to time beside it.
class BusNotes {
 public:
  void error_frame(const Frame& frame) { add(errors_, frame); }
  /// An answer found no room in the transmit queue by its deadline.
  void late_in_queue() { ++late_in_queue_; }
  /// An answer met an interface that is down.
  void met_interface_down() { ++unsent_; }
  /// Whether it is up; asked so often that no outage is missed between two news.
  void interface_is(bool up);

  /// One line for each thing that changed since it was asked last, with the bus's name; empty: nothing did.
  /// What may flood, error frames that are no change of state and frames of the other contract, is told of
  /// once a second.
  std::string news(const Port& port, BusFormat format);

 private:
  struct Told {
    BusErrors errors;
    std::int64_t errors_ns = 0;
    std::uint64_t late_in_queue = 0;
    std::uint64_t overflowed = 0;
    std::uint64_t foreign = 0;
    std::int64_t foreign_ns = 0;
    std::uint64_t downs = 0;
    bool up = true;
  };
  BusErrors errors_;
  std::uint64_t late_in_queue_ = 0;
  std::uint64_t unsent_ = 0;  // since the last outage was told
  std::uint64_t downs_ = 0;
  bool up_ = true;
  std::int64_t changed_ns_ = 0;
  std::int64_t last_outage_ns_ = 0;
  Told told_;
};

}  // namespace canhil::target
