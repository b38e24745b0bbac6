// The text of canhil.dbc, built into the program.
#pragma once

#include "dbc/text/embedded_file.hpp"

namespace canhil::bindings {

extern const EmbeddedFiles contract_text;

}  // namespace canhil::bindings
