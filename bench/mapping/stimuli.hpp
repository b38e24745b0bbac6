// The measurements of the bench's nodes as quantities that a mapping may play: by name and in SI, independent
// of the messages in canhil's own DBC.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/message_info.hpp"

namespace canhil::mapping {

/// How samples in an interval are combined to a value at its end.
enum class Over : std::uint8_t {
  newest,  ///< a value
  sum,     ///< an increment
  rate     ///< an increment divided by its interval
};

/// A measurement. Its name comes from the DBC: NODE.SIGNAL without the unit ("gps.latitude"); a rate has the
/// node's name for it ("imu.rate.z").
struct Stimulus {
  std::string name;
  std::string_view si;    ///< its unit
  std::string_view node;  ///< the table that the scenario must have: "slave_imu"
  const MessageInfo* message = nullptr;
  std::string_view signal;  ///< of the message
  std::string_view column;  ///< in a recording (docs/recorded-data.md): the signal, or the rate in SI
  double factor = 1;        ///< from the signal's unit to SI
  Over over = Over::newest;
};

/// All stimuli, in the order of the nodes.
std::span<const Stimulus> stimuli();
/// Null if there is none.
const Stimulus* find_stimulus(std::string_view name);

}  // namespace canhil::mapping
