// Formats the reference as Markdown and as JSON.
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

}  // namespace canhil::reference
