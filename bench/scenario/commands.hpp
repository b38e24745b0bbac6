// What a scenario lets the bench execute: shell commands, and programs and libraries that are plants.
#pragma once

#include <string>
#include <string_view>

namespace canhil::scenario {

class Section;

/// From now on, reading a scenario that would execute something is an error (the option --no-commands). To be
/// called before the first scenario is read.
void forbid_commands();

/// Reports an error to the section if commands are forbidden, and returns false. `what`: what the key's value
/// is, "is a shell command ('...')".
bool may_execute(Section& section, std::string_view key, const std::string& what);

}  // namespace canhil::scenario
