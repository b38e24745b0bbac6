// The text of canhil.dbc, built into the program.
#pragma once

#include "bench/report/embedded_file.hpp"

namespace canhil::bindings {

extern const report::EmbeddedFiles contract_text;

}  // namespace canhil::bindings
