// The style of the papers' pages, built into the program.
#pragma once

#include "dbc/text/embedded_file.hpp"

namespace canhil::papers {

extern const EmbeddedFiles styles;

}  // namespace canhil::papers
