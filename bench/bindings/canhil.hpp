// The binding of canhil.dbc, the contract between bench and hil-target.
#pragma once

#include <memory>

#include "bench/scenario/binding.hpp"

namespace canhil::bindings {

/// The binding of canhil.dbc; always the same object.
std::shared_ptr<const scenario::Binding> canhil();

}  // namespace canhil::bindings
