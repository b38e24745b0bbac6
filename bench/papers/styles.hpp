// The style of the papers' pages, built into the program.
#pragma once

#include "bench/report/embedded_file.hpp"

namespace canhil::papers {

extern const report::EmbeddedFiles styles;

}  // namespace canhil::papers
