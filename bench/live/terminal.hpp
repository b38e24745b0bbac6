// The live view on a terminal; the implementation uses ncurses.
#pragma once

#include <memory>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// Takes over the terminal of standard output until the display is destroyed. Text written to standard error
/// meanwhile is printed afterwards. Error, one line: standard output is not a terminal.
Result<std::unique_ptr<Display>> open_terminal();

}  // namespace canhil::live
