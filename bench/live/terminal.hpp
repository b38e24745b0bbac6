// The live view on a terminal; the implementation uses ncurses.
#pragma once

#include <memory>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// Takes over the terminal of standard output until the display is destroyed. Text that is written to
/// standard error in the meantime is printed afterwards. Returns an Error of one line if standard output is
/// not a terminal.
Result<std::unique_ptr<Display>> open_terminal();

}  // namespace canhil::live
