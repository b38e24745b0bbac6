// What the bench's nodes measure, as quantities that a mapping may play: by name and in SI, whatever messages
// the project's own contract has for them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/message_info.hpp"

namespace canhil::mapping {

/// How the samples of an interval become the value at its end.
enum class Over : std::uint8_t {
  newest,  ///< a value
  sum,     ///< an increment
  rate     ///< an increment by the time it took
};

/// One of them. From the DBC: NODE.SIGNAL without its unit ("gps.latitude"); rates as the node names them
/// ("imu.rate.z").
struct Stimulus {
  std::string name;
  std::string_view si;    ///< its unit
  std::string_view node;  ///< whose table the scenario must have: "slave_imu"
  const MessageInfo* message = nullptr;
  std::string_view signal;  ///< of the message
  std::string_view column;  ///< of a recording (docs/recorded-data.md): the signal, or the rate in SI
  double factor = 1;        ///< from the signal's unit to SI
  Over over = Over::newest;
};

/// All of them, in the order of the nodes.
std::span<const Stimulus> stimuli();
/// None: null.
const Stimulus* find_stimulus(std::string_view name);

}  // namespace canhil::mapping
