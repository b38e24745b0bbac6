// The kinds of sensors.
#pragma once

#include <span>
#include <string>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

/// All kinds, in the order in which they are listed in messages and pages.
std::span<const Kind* const> all();

/// A sensor of a kind with a name of its own, so that a scenario may have several of them. Repeated calls
/// return the same object.
const Kind& named(const Kind& kind, std::string_view name);

/// A value that a mapping declares. `si`: its SI unit; empty: a plain number.
struct DeclaredValue {
  std::string name;
  std::string_view si;
  bool turns = false;
  friend bool operator==(const DeclaredValue&, const DeclaredValue&) = default;
};

/// The generic sensor with this name and these values, at most Sample::most_values. Repeated calls return the
/// same object.
const Kind& declared(std::string_view name, const std::vector<DeclaredValue>& values);

}  // namespace canhil::sensors
