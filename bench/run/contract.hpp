// The names that scenarios may use, from the DBC that this bench was built with.
#pragma once

#include "bench/scenario/contract.hpp"

namespace canhil::run {

/// Value tables and messages of the built-in DBC.
scenario::Contract contract();

/// Whether frames round measurements: false in the twin of this bench that was built to show what the
/// rounding does.
bool frames_round();

}  // namespace canhil::run
