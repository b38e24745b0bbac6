// Properties of a run's bus and target that faults may depend on.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/ports/port.hpp"

namespace canhil::faults {

struct Place {
  enum class Interface : std::uint8_t { none, virtual_can, controller };
  std::string bus{};                      ///< as given to --bus
  Interface interface = Interface::none;  ///< an interface of the kernel; none: another kind of bus
  bool may_set_interface = false;         ///< it is allowed to set the interface up and down
  bool virtual_time = false;              ///< time advances in steps that the target completes
  bool in_process = false;                ///< the target is a device within the bench's process
  bool starts_target = false;             ///< the bench starts the target's process
  bool mapped = false;                    ///< the target has its own DBC, used through a mapping
  bool fd = false;                        ///< FD frames are allowed
  WireFacts wire{};
};

}  // namespace canhil::faults
