// Reads what is added to a built-in motion: [truth.vibration] and [truth.sea].
#pragma once

#include <memory>

namespace canhil::world {
struct OscillationModel;
}

namespace canhil::scenario {

class Section;

/// Null: there are none. `built_in`: whether the motion can have oscillations; if not, their tables are
/// rejected.
std::shared_ptr<const world::OscillationModel> read_oscillations(Section& truth, bool built_in);

}  // namespace canhil::scenario
