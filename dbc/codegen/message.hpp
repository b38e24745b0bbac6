// Generates the struct of one message. This header is internal to dbcgen.
#pragma once

#include <string>

#include "dbc/codegen/names.hpp"

namespace canhil::dbc {

/// The C++ text of the struct.
std::string message_text(const Enums& enums, const Message& message);

}  // namespace canhil::dbc
