// A program of the user that is a node of the bus (docs/programs.md).
#pragma once

#include <string>
#include <vector>

#include "bench/processes/program_settings.hpp"

namespace canhil::scenario {

class Section;

/// A table [[node]].
struct NodeProgram {
  std::string name;
  processes::ProgramSettings program;
};

/// Reads the tables [[node]] of a scenario.
std::vector<NodeProgram> read_node_programs(Section& root);

}  // namespace canhil::scenario
