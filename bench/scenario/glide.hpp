// [glide], [wind] and [airframe]: the truth of a glider. One flight a run, as its errors are drawn anew.
#pragma once

#include <array>
#include <string_view>

#include "bench/world/glide/glide.hpp"

namespace canhil::scenario {

class Section;

/// How wrong the target is told the state at release: 1-sigma of each component.
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

/// The tables of its truth.
inline constexpr std::array<std::string_view, 3> glide_tables{"glide", "wind", "airframe"};

/// `root`: the file; `section`: its [glide]. [wind] is needed, [airframe] is not.
Glide read_glide(Section& root, Section& section);

}  // namespace canhil::scenario
