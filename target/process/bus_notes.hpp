// The target process's messages about the bus, for stderr.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/ports/bus_errors.hpp"
#include "dbc/ports/fd_groups.hpp"

namespace canhil::target {

/// Counts the events of a bus; news() reports the counts. The functions that are called for single frames do
/// nothing but count, so that they are fast.
class BusNotes {
 public:
  void error_frame(const Frame& frame) { add(errors_, frame); }
  /// An answer found no room in the transmit queue by its deadline.
  void late_in_queue() { ++late_in_queue_; }
  /// An answer was not sent because the interface is down.
  void met_interface_down() { ++unsent_; }
  /// Stores whether the interface is up. An outage is noticed only if this function is called during the
  /// outage. Therefore call this function more often than news().
  void interface_is(bool up);

  /// Returns one line with the bus's name for each change since the last call, or an empty string. Events
  /// that may come in floods (error frames without a change of state, FD frames on a classic bus, classic
  /// frames on an FD bus) are reported at most once per second.
  std::string news(const Port& port, BusFormat format);

 private:
  struct Reported {
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
  std::uint64_t unsent_ = 0;  // answers not sent; 0 again after the report that the interface is up
  std::uint64_t downs_ = 0;
  bool up_ = true;
  std::int64_t changed_ns_ = 0;
  std::int64_t last_outage_ns_ = 0;
  Reported reported_;
};

}  // namespace canhil::target
