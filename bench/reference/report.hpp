// Formats the reference as Markdown, as JSON, and as a JSON schema.
#pragma once

#include <string>
#include <vector>

#include "bench/reference/parts.hpp"

namespace canhil::reference {

/// A page of Markdown: docs/scenario-reference.md.
std::string markdown(const std::vector<Part>& parts);
/// A JSON object: {"parts": [{"title", "tables": [{"name", "about", "keys": [...]}]}]}. Each key has all its
/// known properties.
std::string json(const std::vector<Part>& parts);
/// A JSON schema (draft 7) of scenario files, for editors: docs/scenario.schema.json. It knows the tables,
/// their keys, types and ranges. What depends on other keys is left to the reader: kinds have the keys of all
/// kinds.
std::string schema(const std::vector<Part>& parts);

}  // namespace canhil::reference
