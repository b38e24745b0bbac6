// The kinds of faults that a scenario may have.
#pragma once

#include <span>
#include <vector>

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// All kinds, stage by stage.
std::span<const Listed> listed_kinds();

/// The kinds for scenario::DbcVocabulary.
std::vector<scenario::FaultKind> kinds();

}  // namespace canhil::faults
