#include "bench/fault_matrix/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "bench/fault_matrix/drawn.hpp"
#include "bench/fault_matrix/response.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::fault_matrix {
namespace {

using scenario::Section;
using scenario::Setting;

constexpr int at_once = 3;

// What a row has for a cell; none: it does not fit the scenario.
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

// Whether a value lists a text, in quotes of either kind.
bool lists(const Setting& value, std::string_view text) {
  return std::ranges::any_of(value.elements, [&](const std::string& element) {
    return element.size() == text.size() + 2 && std::string_view(element).substr(1, text.size()) == text;
  });
}

// Why a fault does not fit a scenario; empty: it does.
std::string unfit(const Column& column, const std::vector<FaultText>& faults) {
  for (const FaultText& fault : faults) {
    const Setting* named = fault.find("messages");
    for (const MessageInfo& info : messages::all_messages) {
      if (named == nullptr || !lists(*named, info.name)) continue;
      const bool sent = std::ranges::any_of(column.scenario.nodes, [&](const scenario::NodeSettings& node) {
        return node.table().closes.sample_group == info.sample_group;
      });
      if (!sent) return fmt::format("{}: nobody sends {}", column.file, info.name);
    }
  }
  const auto scenario = scenario_of(column, 0, faults);
  return scenario ? "" : scenario.error().message;
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
      [&](std::size_t row, std::size_t place, std::uint64_t run) -> std::optional<std::vector<FaultText>> {
        const Column& column = plan.columns[place];
        if (row > drawn.size()) return drawn_faults(at_once, fitting[place], column, seed, run);
        if (std::ranges::find(fitting[place], drawn[row - 1]) == fitting[place].end()) return std::nullopt;
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
  Section root = Section::parse(*text, set_file);
  for (Section& section : root.tables("fault")) {
    const std::string kind = section.text("kind");
    const std::string name = section.text("name", fmt::format("{} {}", kind, sets.size()));
    const std::string row = section.text("together", name);
    FaultText fault;
    for (Setting& key : section.settings()) {
      if (key.key != "together") fault.keys.push_back(std::move(key));
    }
    const auto known = std::ranges::find(plan.rows, row, &Row::fault);
    if (known == plan.rows.end()) {
      plan.rows.push_back({.fault = row});
      sets.push_back({std::move(fault)});
    } else if (section.has("together")) {
      sets[static_cast<std::size_t>(known - plan.rows.begin())].push_back(std::move(fault));
    } else {
      section.reject("name", fmt::format("'{}' is there twice", row), "each once");
    }
  }
  root.finish();
  if (const auto error = root.error()) return tl::unexpected(*error);
  std::vector<std::vector<bool>> fits;
  for (std::size_t row = 0; row < sets.size(); ++row) {
    std::string why;
    fits.emplace_back();
    for (const Column& column : plan.columns) {
      const std::string reason = unfit(column, sets[row]);
      fits.back().push_back(reason.empty());
      if (why.empty()) why = reason;
    }
    if (row > 0 && std::ranges::find(fits.back(), true) == fits.back().end())
      return failure(fmt::format("{}: fault '{}' fits no scenario: {}", set_file, plan.rows[row].fault, why));
  }
  add_cells(plan,
            [&](std::size_t row, std::size_t column, std::uint64_t) -> std::optional<std::vector<FaultText>> {
              if (!fits[row][column]) return std::nullopt;
              return sets[row];
            });
  return plan;
}

}  // namespace canhil::fault_matrix
