// Runs Debian's gnuplot as a child process: reads a script, writes one SVG.
#pragma once

#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::papers {

/// Error: gnuplot cannot be started; one line. Call this before a long run.
Result<void> check_gnuplot();

/// The standard output of gnuplot for a script on its standard input; the script contains the data as
/// here-documents. Error: one line; gnuplot cannot be started, or reports an error.
Result<std::string> gnuplot(std::string_view script);

}  // namespace canhil::papers
