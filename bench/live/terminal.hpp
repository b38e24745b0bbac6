// One screen of a terminal, by ncurses, behind this header.
#pragma once

#include <memory>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// Takes the terminal of standard output until the display is destroyed. Text written to standard error
/// meanwhile is printed then. Error: one line; standard output is not a terminal.
Result<std::unique_ptr<Display>> open_terminal();

}  // namespace canhil::live
