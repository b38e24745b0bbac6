// The style of the run's page, built into the program.
#pragma once

#include "bench/report/embedded_file.hpp"

namespace canhil::report {

extern const EmbeddedFiles styles;

}  // namespace canhil::report
