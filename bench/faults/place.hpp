// Properties of a run's bus and target that faults may depend on.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/ports/port.hpp"

namespace canhil::faults {

struct Place {
  enum class Interface : std::uint8_t { none, virtual_can, controller };
  std::string bus{};                      ///< value of --bus
  Interface interface = Interface::none;  ///< kind of kernel interface; none: another bus
  bool may_set_interface = false;         ///< the bench may set the interface up and down
  bool virtual_time = false;              ///< time advances when the target completes a step
  bool in_process = false;                ///< the target is a Device in the bench's process
  bool starts_target = false;             ///< the bench starts the target's process
  bool handshake = true;                  ///< see scenario::Binding
  bool fd = false;                        ///< FD frames are allowed
  WireFacts wire{};
};

}  // namespace canhil::faults
