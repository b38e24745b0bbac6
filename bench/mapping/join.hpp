// Several targets on one bus, each with a mapping of its own.
#pragma once

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

/// Reads the mapping of one target, as the user wrote it: put_together() derives the rest.
Result<std::shared_ptr<Mapping>> read_alone(const std::string& file, const ReadText& read);

/// Adds the mapping of a further target to the mappings of the targets before it. Plays that are equal are
/// sent once. A message whose name another DBC gives to another id gets the name TARGET.MESSAGE. Error, one
/// line: the bench would have to send a message in two ways, or a message that another target sends.
Result<void> join(Mapping& all, Mapping&& further);

}  // namespace canhil::mapping
