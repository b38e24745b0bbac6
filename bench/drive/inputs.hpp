// The files that a run reads.
#pragma once

#include <string>
#include <vector>

#include "dbc/files/command_files.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::drive {

/// The files that a scenario reads: itself, its mapping and DBC, its recordings and faults.
std::vector<CommandFiles::File> inputs_of(const scenario::Scenario& scenario);
/// The files of a target's command: the program and its arguments that are files.
std::vector<CommandFiles::File> inputs_of_target(const std::string& command);

}  // namespace canhil::drive
