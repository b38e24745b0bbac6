// The keys of a program of the user that the bench starts: a plant, a sensor, a node.
#pragma once

#include <optional>

#include "bench/processes/program_settings.hpp"

namespace canhil::scenario {

class Section;

/// Reads how the program is started. None: a key is wrong or missing, or commands are forbidden, and the
/// error is reported.
std::optional<processes::ProgramSettings> read_program(Section& section);

}  // namespace canhil::scenario
