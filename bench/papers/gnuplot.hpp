// Debian's gnuplot as a child process: a script in, one SVG out.
#pragma once

#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::papers {

/// Whether gnuplot can be started, to be checked before a long run. Error: one line.
Result<void> check_gnuplot();

/// The standard output of gnuplot for a script on its standard input; data are inside the script, as
/// here-documents. Error, one line: it cannot be started, or it reports an error.
Result<std::string> gnuplot(std::string_view script);

}  // namespace canhil::papers
