// Drafts of a mapping and of a scenario, made from a DBC: what the names and units of its signals tell is
// filled in, the rest is left to the user as comments.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

/// The text of a file, in blocks. The reader must accept the first one; each other may be left out.
using Blocks = std::vector<std::string>;

/// A mapping for the node `device` of a DBC: a play for each message that it receives, and a hear for each
/// that it sends. `dbc`: the DBC's file, as the mapping names it.
Blocks draft_of_mapping(const dbc::Database& database, std::string_view device, const std::string& dbc);

/// A scenario for a target with a mapping: a flight with turns, the sensors that the mapping plays without
/// errors, and a check of each quantity that the target reports. `file`: the mapping, as the scenario names
/// it.
Blocks draft_of_scenario(const Mapping& mapping, const std::string& file);

/// A text that its reader accepts, as far as this is possible, and what it still rejects.
struct Draft {
  std::string text;
  std::optional<Error> error{};
};
/// Joins the blocks. While `read` rejects the text with an error of a line ("FILE:LINE: ..."), turns the
/// block with this line into comments, below the error.
Draft joined(Blocks blocks, const std::function<std::optional<Error>(const std::string& text)>& read);

}  // namespace canhil::mapping
