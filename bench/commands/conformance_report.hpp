// The report of `hil-bench conformance`.
#pragma once

#include <string>

#include "bench/conformance/conformance.hpp"

namespace canhil::conformance {

/// For people: one line for each rule; a second line describes the violation, if there is one.
std::string text(const Report& report);
std::string json(const Report& report);
std::string junit(const Report& report);

}  // namespace canhil::conformance
