// The two planes of a seeker.
#pragma once

namespace canhil::world {

/// A pair of values, one for each plane: pitch (about y of the antenna, positive nose up) and yaw (about z,
/// positive nose right).
template <class Value>
struct Planes {
  Value pitch{}, yaw{};
  bool operator==(const Planes&) const = default;
};

}  // namespace canhil::world
