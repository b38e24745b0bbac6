// Whether a value fits into its signal.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/message_info.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::nodes {

/// The error message for a value that does not fit its signal: one line.
std::string misfit(std::string_view what, double value, const MessageInfo& message, const SignalInfo& signal);

/// Returns an error if the signal interval_us of the message cannot carry `interval_us` exactly.
Result<void> check_interval(std::string_view what, std::int64_t interval_us, const MessageInfo& message,
                            std::span<const SignalInfo> signals);

}  // namespace canhil::nodes
