// The members of a mapping that follow from what was read.
#pragma once

#include <optional>
#include <string>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

/// Derives all other members of a mapping from what was read. If the mapping is invalid, returns the reason.
std::optional<std::string> put_together(Mapping& mapping);

/// The page of a multiplexed message, by the constants of its multiplexors: "Page=1"; empty: it has no pages.
std::string page_of(const PlayedMessage& message);

}  // namespace canhil::mapping
