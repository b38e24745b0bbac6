// One screen of a terminal, by ncurses, behind this header.
#pragma once

#include <memory>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// Takes the terminal of standard output until it is destroyed. What is written to standard error meanwhile
/// comes out then. Error: one line; standard output is no terminal.
Result<std::unique_ptr<Display>> open_terminal();

}  // namespace canhil::live
