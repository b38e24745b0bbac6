// The cells of a matrix in a few words, and as tables for people.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/fault_matrix/results.hpp"

namespace canhil::fault_matrix {

/// The runs of one fault in one scenario.
using Cells = std::vector<const Finished*>;
Cells cells_of(const Results& results, std::size_t row, std::size_t column);

/// The worst first.
inline constexpr std::array kinds_by_weight{Response::Kind::violated, Response::Kind::not_measured,
                                            Response::Kind::ended, Response::Kind::detected,
                                            Response::Kind::tolerated};
/// "1 violated honest; 2 detected in 0.020 s, recovered in 0.100 s", without counts of a single run; "-":
/// none.
std::string summary(const Cells& cells);

/// The scenario's file, without folder and ending.
std::string head_of(const Identity::Column& column);

/// A fault a row; where faults are of nodes, a table for each scenario and a column for each of its nodes,
/// else one table and a column for each scenario.
struct Table {
  std::string title{};  ///< empty: there is one
  std::vector<std::string> heads{};
  std::vector<std::pair<std::string, std::vector<Cells>>> rows{};
};
std::vector<Table> tables(const Results& results);

}  // namespace canhil::fault_matrix
