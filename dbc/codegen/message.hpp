// The generated struct of one message. Internal to dbcgen.
#pragma once

#include <string>

#include "dbc/codegen/names.hpp"

namespace canhil::dbc {

/// The struct, as C++.
std::string message_text(const Enums& enums, const Message& message);

}  // namespace canhil::dbc
