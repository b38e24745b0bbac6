// Short summaries of the matrix's cells, and tables for people.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/evaluate.hpp"

namespace canhil::campaign {

/// The responses of a campaign with faults.
struct Responses {
  const matrix::Matrix& matrix;
  std::uint64_t runs;
  const Evaluation& evaluation;
};
Responses responses_in(const Campaign& campaign, const Evaluation& evaluation);

/// The runs of one fault in one scenario.
using Cells = std::vector<const Responded*>;
Cells cells_of(const Responses& all, std::size_t row, std::size_t column);

/// The kinds of responses, from worst to best.
inline constexpr std::array kinds_by_weight{
    matrix::Response::Kind::violated, matrix::Response::Kind::not_measured, matrix::Response::Kind::ended,
    matrix::Response::Kind::detected, matrix::Response::Kind::tolerated};
/// A text such as "1 violated honest; 2 detected in 0.020 s, recovered in 0.100 s". If there is a single run,
/// the text has no counts. "-" means that there are no cells.
std::string summary(const Cells& cells);

/// The estimators of a scenario: "los_rate, wind".
std::string estimators_of(const matrix::Column& column);

/// A table has one row per fault. If the faults belong to nodes, there is a table for each scenario, with a
/// column for each node of the scenario. Otherwise there is one table, with a column for each scenario.
struct Table {
  std::string title{};  ///< empty: there is only one table
  std::vector<std::string> heads{};
  std::vector<std::pair<std::string, std::vector<Cells>>> rows{};
};
std::vector<Table> tables(const Responses& all);

}  // namespace canhil::campaign
