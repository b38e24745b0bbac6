// The reference as text.
#pragma once

#include <string>
#include <vector>

#include "bench/reference/parts.hpp"

namespace canhil::reference {

/// A page of Markdown: docs/scenario-reference.md.
std::string markdown(const std::vector<Part>& parts);
/// {"parts": [{"title", "tables": [{"name", "about", "keys": [...]}]}]}, each key with all its known
/// properties.
std::string json(const std::vector<Part>& parts);

}  // namespace canhil::reference
