// Reads [glide], [wind] and [airframe]: the truth of a glider. Each run has its own flight, because
// errors are drawn for each run.
#pragma once

#include <array>
#include <string_view>

#include "bench/world/glide/glide.hpp"

namespace canhil::scenario {

class Section;

/// Errors of the state that the target receives at release: 1-sigma of each component.
struct ReleaseError {
  double air_velocity = 0;  ///< body [m/s]
  double velocity = 0;      ///< NED [m/s]
  double attitude = 0;      ///< roll, pitch, heading [rad]
  double rate = 0;          ///< body [rad/s]
};

struct Glide {
  world::GlidePlan plan;
  ReleaseError release;
};

/// The tables of the glider's truth.
inline constexpr std::array<std::string_view, 3> glide_tables{"glide", "wind", "airframe"};

/// `root`: the whole file; `section`: its table [glide]. [wind] is required, [airframe] is optional.
Glide read_glide(Section& root, Section& section);

}  // namespace canhil::scenario
