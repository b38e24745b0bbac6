#include "bench/fault_matrix/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <random>

#include "bench/fault_matrix/response.hpp"
#include "bench/observe/values.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::fault_matrix {
namespace {

using scenario::Section;
using scenario::Setting;

// What is drawn for one cell: by seed, row, scenario and run alone.
class Draw {
 public:
  Draw(std::uint64_t seed, const std::string& row, const Column& column, std::uint64_t run)
      : engine_(world::fnv1a_64(fmt::format("{} {} {} {}", seed, row, column.scenario.title, run))) {}

  double between(double low, double high) {
    constexpr double unit = 0x1p-53;  // 53 random bits make a double in [0, 1)
    return low + (high - low) * unit * static_cast<double>(engine_() >> 11U);
  }
  std::size_t one_of(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0, static_cast<double>(count))));
  }

 private:
  std::mt19937_64 engine_;
};

std::string quoted(std::string_view text) { return fmt::format("\"{}\"", text); }

// A fault of a kind on all messages of a node; `changed` on one signal of one of them.
FaultText make_fault(std::string_view kind, const scenario::NodeSettings& node, double duration_s,
                     Draw& draw) {
  std::vector<const MessageInfo*> group;
  for (const MessageInfo& info : messages::all_messages) {
    if (info.sample_group == node.table().closes.sample_group && info.sender == node.table().closes.sender)
      group.push_back(&info);
  }
  // Within the flight, so that what was before is known, and there is time to recover.
  const double from_s = duration_s * draw.between(0.3, 0.6);
  const double length_s = duration_s * draw.between(0.01, 0.15);
  constexpr std::array<int, 4> every{1, 2, 5, 10};
  FaultText fault;
  fault.set("kind", quoted(kind));
  std::vector<std::string> names;
  if (kind == "changed") {
    const MessageInfo& message = *group[draw.one_of(group.size())];
    const auto signals = observe::signals_of(message);
    const SignalInfo& signal = *signals[draw.one_of(signals.size())];
    names = {quoted(message.name)};
    fault.set("signal", quoted(signal.name));
    fault.set("value", fmt::format("{}", draw.between(signal.minimum, signal.maximum)));
  } else {
    for (const MessageInfo* message : group) names.push_back(quoted(message->name));
  }
  fault.set("messages", fmt::format("[{}]", fmt::join(names, ", ")));
  fault.set("from_s", fmt::format("{:.3f}", from_s));
  fault.set("to_s", fmt::format("{:.3f}", from_s + length_s));
  fault.set("every", std::to_string(every[draw.one_of(every.size())]));
  return fault;
}

constexpr std::array<std::string_view, 6> kinds{"lost",      "damaged", "repeated",
                                                "too_short", "foreign", "changed"};
constexpr std::string_view three_at_once = "three at once";

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
  plan.rows.emplace_back(no_fault);
  std::vector<std::pair<std::string_view, std::string_view>> parts{{}};  // of a row: kind, node
  for (const Column& column : plan.columns) {
    for (const scenario::NodeSettings& node : column.scenario.nodes) {
      for (const std::string_view kind : kinds) {
        std::string name = fmt::format("{} {}", kind, node.table().key);
        if (std::ranges::find(plan.rows, name) != plan.rows.end()) continue;
        plan.rows.push_back(std::move(name));
        parts.emplace_back(kind, node.table().key);
      }
    }
  }
  plan.rows.emplace_back(three_at_once);
  add_cells(
      plan,
      [&](std::size_t row, std::size_t place, std::uint64_t run) -> std::optional<std::vector<FaultText>> {
        const Column& column = plan.columns[place];
        const double duration_s = static_cast<double>(column.scenario.duration_us) * 1e-6;
        Draw draw(seed, plan.rows[row], column, run);
        std::vector<FaultText> faults;
        if (row == parts.size()) {
          for (int i = 0; i < 3; ++i) {
            const auto& nodes = column.scenario.nodes;
            faults.push_back(make_fault(kinds[draw.one_of(kinds.size())], nodes[draw.one_of(nodes.size())],
                                        duration_s, draw));
          }
          return faults;
        }
        const scenario::NodeSettings* node = column.scenario.node(parts[row].second);
        if (node == nullptr) return std::nullopt;
        faults.push_back(make_fault(parts[row].first, *node, duration_s, draw));
        return faults;
      });
  return plan;
}

Result<Plan> plan_of(std::vector<Column> columns, const std::string& set_file, std::uint64_t seed,
                     std::uint64_t runs) {
  const auto text = read_text_file(set_file, "a set of faults", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  Plan plan{.seed = seed, .runs = runs, .set_hash = world::fnv1a_64(*text), .columns = std::move(columns)};
  plan.rows.emplace_back(no_fault);
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
    const auto known = std::ranges::find(plan.rows, row);
    if (known == plan.rows.end()) {
      plan.rows.push_back(row);
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
      return failure(fmt::format("{}: fault '{}' fits no scenario: {}", set_file, plan.rows[row], why));
  }
  add_cells(plan,
            [&](std::size_t row, std::size_t column, std::uint64_t) -> std::optional<std::vector<FaultText>> {
              if (!fits[row][column]) return std::nullopt;
              return sets[row];
            });
  return plan;
}

}  // namespace canhil::fault_matrix
