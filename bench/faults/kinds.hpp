// The kinds of faults that a scenario may have.
#pragma once

#include <span>
#include <vector>

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// All of them, stage by stage.
std::span<const Listed> listed_kinds();

/// For scenario::DbcVocabulary.
std::vector<scenario::FaultKind> kinds();

}  // namespace canhil::faults
