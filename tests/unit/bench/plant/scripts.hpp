// Small programs for tests, in the test's own folder.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/own_folder.hpp"

namespace canhil::test {

/// Writes a shell script, and returns its path.
inline std::string script(const std::string& name, const std::string& lines) {
  std::string path = own_folder() + "/" + name;
  std::ofstream(path) << "#!/bin/sh\n" << lines << '\n';
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

/// Shell commands of a plant with one input and two outputs that answers correctly up to its first step:
/// then the text of the step is in $step.
inline const std::string up_to_first_step =
    "while read line && [ \"$line\" != start ]; do :; done\n"
    "printf 'input valve 1\\noutput level m\\noutput flow 1\\nstate 1 2\\n'\n"
    "read step\n";

}  // namespace canhil::test
