// Short summaries of the matrix's cells, and tables for people.
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

/// The kinds of responses, from worst to best.
inline constexpr std::array kinds_by_weight{Response::Kind::violated, Response::Kind::not_measured,
                                            Response::Kind::ended, Response::Kind::detected,
                                            Response::Kind::tolerated};
/// A text such as "1 violated honest; 2 detected in 0.020 s, recovered in 0.100 s". If there is a single run,
/// the text has no counts. "-" means that there are no cells.
std::string summary(const Cells& cells);

/// The name of the scenario's file, without folder and extension.
std::string head_of(const Identity::Column& column);

/// A table has one row per fault. If the faults belong to nodes, there is a table for each scenario, with a
/// column for each node of the scenario. Otherwise there is one table, with a column for each scenario.
struct Table {
  std::string title{};  ///< empty: there is only one table
  std::vector<std::string> heads{};
  std::vector<std::pair<std::string, std::vector<Cells>>> rows{};
};
std::vector<Table> tables(const Results& results);

}  // namespace canhil::fault_matrix
