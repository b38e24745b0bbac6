#include "bench/fault_matrix/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "bench/drive/contract.hpp"
#include "bench/fault_matrix/drawn.hpp"
#include "bench/fault_matrix/response.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::fault_matrix {
namespace {

using scenario::Section;
using scenario::Setting;

constexpr int at_once = 3;

// The faults of a row in a cell; nullopt if the row does not fit the scenario.
using FaultsOf = std::function<std::optional<std::vector<FaultText>>(std::size_t row, std::size_t column,
                                                                     std::uint64_t run)>;

void add_cells(Plan& plan, const FaultsOf& faults_of) {
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    for (std::size_t column = 0; column < plan.columns.size(); ++column) {
      for (std::uint64_t run = 0; run < plan.runs; ++run) {
        if (row == 0) {
          plan.cells.push_back({.row = row, .column = column, .run = run});
        } else if (auto faults = faults_of(row, column, run)) {
          plan.cells.push_back({.row = row, .column = column, .run = run, .faults = std::move(*faults)});
        }
      }
    }
  }
}

// The reason why some faults of a set do not fit a scenario; nullopt if all fit.
std::optional<Error> unfit(const Column& column, const std::string& set, const std::string& file,
                           const scenario::FaultPlaces& places) {
  scenario::Scenario scenario = column.scenario;
  scenario.faults.clear();
  const auto added = drive::add_faults(scenario, set, file, &places);
  return added ? std::nullopt : std::optional(added.error());
}

}  // namespace

Plan made_plan(std::vector<Column> columns, std::uint64_t seed, std::uint64_t runs) {
  Plan plan{.seed = seed, .runs = runs, .columns = std::move(columns)};
  std::vector<std::string_view> nodes;
  for (const Column& column : plan.columns) {
    for (const scenario::NodeSettings& node : column.scenario.nodes) {
      if (std::ranges::find(nodes, node.table().key) == nodes.end()) nodes.push_back(node.table().key);
    }
  }
  const std::vector<Drawn> drawn = drawn_rows(nodes);
  plan.rows.push_back({.fault = std::string(no_fault)});
  for (const Drawn& row : drawn)
    plan.rows.push_back({.fault = std::string(row.kind), .node = std::string(row.node)});
  plan.rows.push_back({.fault = fmt::format("{} at once", at_once)});
  std::vector<std::vector<Drawn>> fitting(plan.columns.size());
  for (std::size_t column = 0; column < plan.columns.size(); ++column) {
    for (const Drawn& row : drawn) {
      if (fits(row, plan.columns[column], seed)) fitting[column].push_back(row);
    }
  }
  add_cells(
      plan,
      [&](std::size_t row, std::size_t index, std::uint64_t run) -> std::optional<std::vector<FaultText>> {
        const Column& column = plan.columns[index];
        if (row > drawn.size()) return drawn_faults(at_once, fitting[index], column, seed, run);
        if (std::ranges::find(fitting[index], drawn[row - 1]) == fitting[index].end()) return std::nullopt;
        auto fault = drawn_fault(drawn[row - 1], column, seed, run);
        if (!fault) return std::nullopt;
        return std::vector{std::move(*fault)};
      });
  return plan;
}

Result<Plan> plan_of(std::vector<Column> columns, const std::string& set_file, std::uint64_t seed,
                     std::uint64_t runs) {
  const auto text = read_text_file(set_file, "a set of faults", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  Plan plan{.seed = seed, .runs = runs, .set_hash = world::fnv1a_64(*text), .columns = std::move(columns)};
  plan.rows.push_back({.fault = std::string(no_fault)});
  std::vector<std::vector<FaultText>> sets{{}};
  std::vector<scenario::FaultPlaces> places{{}};
  Section root = Section::parse(*text, set_file);
  std::vector<Section> sections = root.tables("fault");
  for (std::size_t index = 0; index < sections.size(); ++index) {
    Section& section = sections[index];
    const std::string kind = section.text("kind");
    const std::string name = section.text("name", fmt::format("{} {}", kind, sets.size()));
    const std::string row = section.text("together", name);
    FaultText fault;
    for (Setting& key : section.settings()) {
      if (key.key != "together") fault.keys.push_back(std::move(key));
    }
    const auto known = std::ranges::find(plan.rows, row, &Row::fault);
    const auto at = static_cast<std::size_t>(known - plan.rows.begin());
    if (known == plan.rows.end()) {
      plan.rows.push_back({.fault = row});
      sets.emplace_back();
      places.emplace_back();
    } else if (!section.has("together")) {
      section.reject("name", fmt::format("'{}' is there twice", row), "each once");
    }
    sets[at].push_back(std::move(fault));
    places[at].push_back(index);
  }
  root.finish();
  if (const auto error = root.error()) return tl::unexpected(*error);
  std::vector<std::vector<bool>> fits;
  for (const scenario::FaultPlaces& of_row : places) {
    std::vector<std::optional<Error>> why;
    for (const Column& column : plan.columns) why.push_back(unfit(column, *text, set_file, of_row));
    fits.emplace_back();
    for (const auto& one : why) fits.back().push_back(!one);
    if (std::ranges::find(fits.back(), true) != fits.back().end()) continue;
    const std::string& first = why.front()->message;
    if (std::ranges::all_of(why, [&](const auto& one) { return one->message == first; }))
      return failure(first);
    return failure(fmt::format("{} in {}, and it fits no other scenario", first, plan.columns.front().file));
  }
  add_cells(plan,
            [&](std::size_t row, std::size_t column, std::uint64_t) -> std::optional<std::vector<FaultText>> {
              if (!fits[row][column]) return std::nullopt;
              return sets[row];
            });
  return plan;
}

}  // namespace canhil::fault_matrix
