#include "bench/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/scenario/engagement.hpp"
#include "bench/scenario/initial_error.hpp"
#include "bench/scenario/section.hpp"
#include "bench/scenario/truth.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::scenario {
namespace {

/// Reads the section of a node: it must be there if the estimator cannot do without it.
template <class Node>
std::optional<Node> read_node(Section& root, std::string_view key, bool needed, Node (*read)(Section&)) {
  std::optional<Section> section = needed ? root.table(key) : root.optional_table(key);
  if (!section) return std::nullopt;
  return read(*section);
}

/// The glider's truth and nodes: all of them are there, or none is.
void read_glider(Section& root, Scenario& scenario) {
  constexpr std::array parts{"glide", "wind", "airframe", "glider_nav", "fins"};
  const bool wanted =
      scenario.runs("wind") || std::ranges::any_of(parts, [&](const char* key) { return root.has(key); });
  if (!wanted) {
    for (const char* key : parts) root.optional(key);
    return;
  }
  Section glide = root.table("glide");
  scenario.glide = read_glide(root, glide);
  scenario.glider_nav = read_node<GliderNav>(root, "glider_nav", true, read_glider_nav);
  scenario.fins = read_node<Fins>(root, "fins", true, read_fins);
}

/// The contract that the bus is to carry, if the scenario says so.
std::optional<bool> read_fd(Section& root) {
  root.optional("dbc");
  if (!root.has("dbc")) return std::nullopt;
  static const std::vector<std::string> names{"canhil", "canhil-fd"};
  return root.one_of("dbc", names) == "canhil-fd";
}

std::vector<std::string> estimators_of(const Scenario& scenario) {
  std::vector<std::string> estimators;
  for (const TargetSetup& target : scenario.targets) estimators.push_back(target.estimator);
  return estimators;
}

std::vector<Check> read_checks(Section& root, const Scenario& scenario, const Contract& contract) {
  const std::vector<std::string> estimators = estimators_of(scenario);
  const CheckContext context{
      .duration_us = scenario.duration_us, .contract = contract, .estimators = estimators};
  std::vector<Check> checks;
  for (Section& section : root.tables("check")) {
    Check check = read_check(section, context);
    const auto same = std::ranges::find(checks, check.name, &Check::name);
    if (same != checks.end()) {
      section.reject("name",
                     fmt::format("'{}' is the name of check[{}] too", check.name, same - checks.begin() + 1),
                     "another name");
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

/// The carrier's flight: it may be absent where an engagement or a glide is there. Then nothing that needs it
/// may be.
void read_navigation(Section& root, Scenario& scenario) {
  if (root.has("truth") || !(scenario.engagement || scenario.glide)) {
    Section truth = root.table("truth");
    scenario.truth = read_truth(truth);
    return;
  }
  root.optional("truth");
  for (const std::string_view key : {"initial_error", "master_ins", "slave_imu", "ssbl", "gps"}) {
    if (root.has(key)) root.reject(key, "has nothing to go by", "a table [truth] beside it");
  }
}

/// In-flight alignment takes the fixes of one aid and refuses the other's; nobody else takes any.
void expect_aid(Section& root, const Scenario& scenario, const Contract& contract) {
  const auto target = std::ranges::find(scenario.targets, "inflight_alignment", &TargetSetup::estimator);
  if (target == scenario.targets.end()) {
    for (const std::string_view key : {"ssbl", "gps"}) {
      if (root.has(key))
        root.reject(key, "has fixes that no estimator takes", "estimator inflight_alignment beside it");
    }
    return;
  }
  if (!scenario.ssbl && !scenario.gps)
    root.reject("ssbl", "is missing, as is 'gps'", "at least one of the tables [ssbl] and [gps]");
  if (std::ranges::find(contract.parameters, "aiding") == contract.parameters.end()) return;
  const auto aiding = std::ranges::find(target->parameters, "aiding", &Parameter::name);
  const bool takes_gps = aiding != target->parameters.end() && aiding->value == 1;
  if (takes_gps && !scenario.gps)
    root.reject("gps", "is missing, and parameter aiding = 1 takes no other fixes", "a table, or aiding = 0");
  if (!takes_gps && !scenario.ssbl)
    root.reject("ssbl", "is missing, and parameter aiding = 0 takes no other fixes",
                "a table, or aiding = 1");
}

std::uint64_t hash_of(std::string_view text, std::span<const Setting> settings) {
  std::string all(text);
  for (const Setting& setting : settings) all += fmt::format("{} = {}\n", setting.key, setting.value);
  return world::fnv1a_64(all);
}

}  // namespace

Result<Scenario> parse(std::string_view text, std::string_view name, const Contract& contract,
                       std::span<const Setting> settings) {
  Section root = Section::parse(text, name, settings);
  Scenario scenario;
  scenario.file = name;
  scenario.hash = hash_of(text, settings);
  scenario.title = root.text("title");
  scenario.duration_us = root.time_us("duration_s", Limits::above(0, 86'400));
  scenario.fd = read_fd(root);
  scenario.seed = static_cast<std::uint64_t>(root.integer("seed", 0));
  scenario.targets = read_targets(root, contract);
  if (auto engagement = root.optional_table("engagement")) {
    scenario.engagement = read_engagement(*engagement);
  }
  read_glider(root, scenario);
  read_navigation(root, scenario);
  if (auto initial_error = root.optional_table("initial_error")) {
    scenario.initial_error = read_initial_error(*initial_error);
  }
  const bool transfer = scenario.runs("transfer_alignment");
  scenario.master_ins = read_node<MasterIns>(root, "master_ins", transfer, read_master_ins);
  const bool inflight = scenario.runs("inflight_alignment");
  scenario.slave_imu = read_node<SlaveImu>(root, "slave_imu", transfer || inflight, read_slave_imu);
  scenario.ssbl = read_node<Ssbl>(root, "ssbl", false, read_ssbl);
  scenario.gps = read_node<Gps>(root, "gps", false, read_gps);
  expect_aid(root, scenario, contract);
  scenario.seeker =
      read_node<Seeker>(root, "seeker", scenario.engagement || scenario.runs("los_rate"), read_seeker);
  if (scenario.seeker && !scenario.engagement)
    root.reject("engagement", "is missing", "a table beside [seeker]");
  scenario.checks = read_checks(root, scenario, contract);
  root.finish();
  if (const std::optional<Error> error = root.error()) return tl::unexpected(*error);
  return scenario;
}

Result<Scenario> read_file(const std::filesystem::path& path, const Contract& contract) {
  const auto text = read_text_file(path, "a scenario file", most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path.string(), contract);
}

}  // namespace canhil::scenario
