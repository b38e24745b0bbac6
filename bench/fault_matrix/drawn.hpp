// The random faults of a matrix that is generated from its scenarios.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/fault_matrix/plan.hpp"

namespace canhil::fault_matrix {

/// A row of the matrix before its details are drawn: a kind of fault and the affected node; empty: the bus.
struct Drawn {
  std::string_view kind, node{};
  bool operator==(const Drawn&) const = default;
};
/// All rows for these nodes and for the bus. They contain the kinds of faults that need neither real time nor
/// a bit rate.
std::vector<Drawn> drawn_rows(const std::vector<std::string_view>& nodes);

/// The fault of a cell, determined by seed, row, scenario and run alone. None: the scenario has no such node,
/// or the fault has nothing to affect in the node.
std::optional<FaultText> drawn_fault(const Drawn& row, const Column& column, std::uint64_t seed,
                                     std::uint64_t run);

/// Whether the scenario accepts a fault of this row. It does not if, for example, the sensor has no validity
/// flag. Draws one fault and reads the scenario with it, which takes far longer than the draw.
bool fits(const Drawn& row, const Column& column, std::uint64_t seed);

/// The faults of a cell with several faults. Their rows are drawn from `rows`, all of which fit the scenario.
std::vector<FaultText> drawn_faults(int count, const std::vector<Drawn>& rows, const Column& column,
                                    std::uint64_t seed, std::uint64_t run);

}  // namespace canhil::fault_matrix
