// The names that scenarios may use, from the DBC that this bench was built with.
#pragma once

#include "bench/scenario/contract.hpp"

namespace canhil::drive {

/// Value tables and messages of the built-in DBC.
scenario::Contract contract();

}  // namespace canhil::drive
