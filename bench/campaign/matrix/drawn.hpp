// The random faults of a matrix that is generated from its scenarios.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/campaign/matrix/matrix.hpp"

namespace canhil::campaign::matrix {

/// All rows for these nodes and for the bus. The rows contain the kinds of faults that need neither real time
/// nor a bit rate.
std::vector<Drawn> drawn_rows(const std::vector<std::string_view>& nodes);

/// The fault of a run; it depends only on seed, row, scenario and run. Returns nullopt if the scenario has no
/// such node, or if the node has nothing that the fault can affect.
std::optional<FaultText> drawn_fault(const Drawn& row, const Column& column, std::uint64_t seed,
                                     std::uint64_t run);

/// Whether the scenario accepts a fault of this row. For example, a scenario accepts no `invalid` fault if
/// the sensor has no validity flag. Draws one fault and reads the scenario with this fault; the reading takes
/// far longer than the draw.
bool fits(const Drawn& row, const Column& column, std::uint64_t seed);

/// The faults of a run with several faults. Their rows are drawn from `rows`; every one of `rows` must fit
/// the scenario.
std::vector<FaultText> drawn_faults(int count, const std::vector<Drawn>& rows, const Column& column,
                                    std::uint64_t seed, std::uint64_t run);

}  // namespace canhil::campaign::matrix
