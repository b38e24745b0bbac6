// Quantities that a mapping defines, beside those of the bench (reference_quantities).
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "bench/mapping/reference_quantities.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::mapping {

/// Reads the table [quantities] of a mapping. Each key is a name. Its table has the unit, and possibly the
/// truth: an expression.
std::deque<ReferenceQuantity> read_own_quantities(scenario::Section& section);

/// A command of the target to a plant has a name with this ending. It needs no entry in [quantities]: its
/// unit is that of its signal.
inline constexpr std::string_view command_ending = ".command";
/// Adds a quantity without a truth. `si`: its SI unit; empty: a plain number.
const ReferenceQuantity& add_command(std::deque<ReferenceQuantity>& own, std::string_view name,
                                     std::string_view si);

/// The unit of a quantity that a mapping declares.
struct DeclaredUnit {
  std::string_view si{};  ///< empty: a plain number
  bool turns = false;     ///< an angle: values that differ by a full turn are equal
};
/// Reads the keys `unit` (an SI unit, or "1" for a plain number) and `turns`.
DeclaredUnit read_unit(scenario::Section& section);
/// Reads a key that is a unit, or a table with the keys of read_unit().
DeclaredUnit read_unit(scenario::Section& section, std::string_view key);

}  // namespace canhil::mapping
