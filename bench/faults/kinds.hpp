// The kinds of faults that a scenario may have.
#pragma once

#include <span>
#include <vector>

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// All kinds, ordered by stage.
std::span<const Listed> listed_kinds();

/// All kinds, in the form that scenario::DbcVocabulary needs.
std::vector<scenario::FaultKind> kinds();

}  // namespace canhil::faults
