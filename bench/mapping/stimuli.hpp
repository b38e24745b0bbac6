// The measurements of the bench's nodes, as quantities that a mapping may play. They are identified by name
// and given in SI, independent of the messages in canhil's own DBC.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/message_info.hpp"

namespace canhil::mapping {

/// How the samples of an interval are combined to one value at its end.
enum class Over : std::uint8_t {
  newest,  ///< the newest sample, for a value
  sum,     ///< the sum, for an increment
  rate     ///< the sum of increments divided by the interval
};

/// A measurement. Its name comes from the DBC: NODE.SIGNAL without the unit ("gps.latitude"); the name of a
/// rate is defined by the node ("imu.rate.z").
struct Stimulus {
  std::string name;
  std::string_view si;    ///< SI unit
  std::string_view node;  ///< required table of the scenario: "slave_imu"
  const MessageInfo* message = nullptr;
  std::string_view signal;  ///< name in the node's message
  std::string_view column;  ///< name in a recording (docs/recorded-data.md): signal, or rate in SI
  double factor = 1;        ///< from the signal's unit to SI
  Over over = Over::newest;
  bool turns = false;    ///< an angle: values that differ by a full turn are equal
  bool flagged = false;  ///< its message has a validity flag; if not, a flag of its sample group applies
};

/// All stimuli, in the order of the nodes.
std::span<const Stimulus> stimuli();
/// The stimulus of this name; null if there is none.
const Stimulus* find_stimulus(std::string_view name);

}  // namespace canhil::mapping
