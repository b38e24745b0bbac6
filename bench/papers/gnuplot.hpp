// Runs Debian's gnuplot as a child process, which reads a script and writes one SVG.
#pragma once

#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::papers {

/// Returns an error, one line of text, if gnuplot cannot be started. Call this before a long run.
Result<void> check_gnuplot();

/// Passes a script to the standard input of gnuplot and returns what gnuplot writes to its standard output.
/// The script contains the data as here-documents. If gnuplot cannot be started or reports an error, the
/// error is one line of text.
Result<std::string> gnuplot(std::string_view script);

}  // namespace canhil::papers
