// Where a run takes place, as far as a fault may need it.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/ports/port.hpp"

namespace canhil::faults {

struct Place {
  enum class Interface : std::uint8_t { none, virtual_can, controller };
  std::string bus{};                      ///< as given to --bus
  Interface interface = Interface::none;  ///< of the kernel; none: another kind of bus
  bool may_set_interface = false;         ///< up and down
  bool virtual_time = false;              ///< in steps that the target closes
  bool in_process = false;                ///< the target is the device of the bench
  bool starts_target = false;             ///< the target is a process of the bench
  bool mapped = false;                    ///< the target speaks another contract
  bool fd = false;                        ///< FD frames may be sent
  WireFacts wire{};
};

}  // namespace canhil::faults
