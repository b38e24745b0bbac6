// What is drawn for the flights of a matrix that is made of its scenarios.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/fault_matrix/plan.hpp"

namespace canhil::fault_matrix {

/// A row of the matrix without its text: a kind of fault, and the node that it befalls; empty: the bus.
struct Drawn {
  std::string_view kind, node{};
  bool operator==(const Drawn&) const = default;
};
/// Each kind that works in virtual time and needs no bit rate, on each of these nodes and on the bus.
std::vector<Drawn> drawn_rows(const std::vector<std::string_view>& nodes);

/// The fault of a cell, by seed, row, scenario and run alone. None: the scenario has no such node, or the
/// node nothing that the fault could befall.
std::optional<FaultText> drawn_fault(const Drawn& row, const Column& column, std::uint64_t seed,
                                     std::uint64_t run);

/// Whether the scenario takes such a fault: a sensor may vouch for nothing. A look at one draw; it costs far
/// more than the draw.
bool fits(const Drawn& row, const Column& column, std::uint64_t seed);

/// Of a cell with several faults: those of which rows is drawn too; all of them fit.
std::vector<FaultText> drawn_faults(int count, const std::vector<Drawn>& rows, const Column& column,
                                    std::uint64_t seed, std::uint64_t run);

}  // namespace canhil::fault_matrix
