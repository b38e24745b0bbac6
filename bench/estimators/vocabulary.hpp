// The names that a scenario may use, from the binding of the DBC of its bus.
#pragma once

#include <memory>

#include "bench/scenario/binding.hpp"
#include "bench/scenario/contract.hpp"

namespace canhil::estimators {

/// The vocabulary `of` with the estimators and the messages of a binding in place of its own.
scenario::DbcVocabulary bound_to(scenario::DbcVocabulary of,
                                 std::shared_ptr<const scenario::Binding> binding);

}  // namespace canhil::estimators
