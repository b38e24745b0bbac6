#include "bench/campaign/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bench/drive/contract.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::campaign {
namespace {

namespace fs = std::filesystem;

using scenario::Section;
using scenario::Setting;

void refuse_seed(Section& section, const std::vector<Setting>& settings) {
  if (std::ranges::find(settings, "seed", &Setting::key) == settings.end()) return;
  section.reject("seed", "is the same for all variants", "seed at the top of the campaign");
}

std::vector<Setting> read_set(Section& section, std::string_view meaning) {
  auto set = section.optional_table({"set", meaning});
  if (!set) return {};
  std::vector<Setting> settings = set->settings();
  refuse_seed(*set, settings);
  return settings;
}

Given read_one(Section& section, const std::string& of_campaign, const std::vector<Setting>& of_all) {
  Given given{
      .name = section.text({"name", "Unique name."}),
      .scenario = section.text({"scenario",
                                "Scenario file, relative to the campaign file. Not required if the campaign "
                                "has the key `scenario`."},
                               of_campaign.empty() ? std::nullopt : std::optional(of_campaign)),
      .groups = section.texts({"groups",
                               "Names that stand for this variant and others in `variants` of metrics "
                               "and checks."}),
      .settings = read_set(section,
                           "Keys of the scenario, with values that replace the values in the scenario "
                           "file."),
      .line = section.line()};
  for (const Setting& one : of_all) {
    if (std::ranges::find(given.settings, one.key, &Setting::key) == given.settings.end())
      given.settings.push_back(one);
  }
  section.finish();
  return given;
}

std::string without_quotes(std::string_view value) {
  const bool quoted = value.size() >= 2 && (value.front() == '"' || value.front() == '\'');
  return std::string(quoted ? value.substr(1, value.size() - 2) : value);
}

std::vector<Point> expand(const std::vector<Setting>& sweep) {
  std::vector<Point> points{{}};
  for (const Setting& key : sweep) {
    std::vector<Point> longer;
    for (const Point& point : points) {
      for (const std::string& value : key.elements) {
        Point next = point;
        next.name += fmt::format("{}{}={}", point.name.empty() ? "" : " ", key.key, without_quotes(value));
        next.settings.push_back({.key = key.key, .value = value, .elements = {}, .line = key.line});
        longer.push_back(std::move(next));
      }
    }
    points = std::move(longer);
  }
  return points;
}

// The checks of the campaign that a variant has, as inline tables.
std::vector<std::string> checks_of(const Given& given, const std::vector<GivenCheck>& all) {
  std::vector<std::string> own;
  for (const GivenCheck& check : all) {
    if (check.variants.empty() || std::ranges::find(check.variants, given.name) != check.variants.end())
      own.push_back(check.text);
  }
  return own;
}

// Why a scenario cannot have samples; empty: it can.
std::string why_no_samples(const Given& given, const scenario::Scenario& scenario) {
  for (const estimators::Estimator* estimator : estimators::all()) {
    if (std::string why = scenario::why_no_truth(scenario, estimator->facts); !why.empty())
      return fmt::format("{} has {}, expected a truth to compare with", given.scenario, why);
  }
  if (scenario.targets.size() > 1)
    return fmt::format("{} runs {} estimators, expected one", given.scenario, scenario.targets.size());
  return {};
}

Result<Made> make_one(const Given& given, const Point& point, const Setup& setup,
                      const ScenarioText& beside) {
  std::vector<Setting> settings = given.settings;
  settings.insert(settings.end(), point.settings.begin(), point.settings.end());
  // `given.scenario` is relative to the campaign's folder; paths within the scenario are relative to the
  // scenario.
  const fs::path path = fs::path(setup.sources.file).parent_path() / given.scenario;
  Made made{
      .variant = {.name = point.name.empty() ? given.name : fmt::format("{} {}", given.name, point.name),
                  .given = given.name,
                  .point = point.name,
                  .scenario = {}},
      .column = {.name = {},
                 .file = path.string(),
                 .folder = path.parent_path().string(),
                 .text = setup.sources.scenarios.at(given.scenario),
                 .settings = settings,
                 .scenario = {}}};
  const std::vector<std::string> checks =
      setup.checks == nullptr ? std::vector<std::string>() : checks_of(given, *setup.checks);
  if (!checks.empty())
    settings.push_back(
        {.key = "check", .value = fmt::format("[{}]", fmt::join(checks, ", ")), .elements = {}});
  auto read = drive::parse_scenario(made.column.text, given.scenario, settings, made.column.folder, beside);
  if (!read) return tl::unexpected(read.error());
  if (setup.checks != nullptr && checks.empty()) read->checks.clear();
  if (setup.seed) read->seed = *setup.seed;
  made.column.name = made.variant.name;
  made.column.checks = checks;
  made.column.scenario = *read;
  made.variant.scenario = std::move(*read);
  return made;
}

}  // namespace

std::vector<std::string> names_of(const std::vector<Given>& given) {
  std::vector<std::string> names;
  names.reserve(given.size());
  for (const Given& one : given) names.push_back(one.name);
  return names;
}

std::vector<std::string> read_variants(Section& section, std::string_view meaning,
                                       const std::vector<Given>& given) {
  std::vector<std::string> known = names_of(given);
  for (const Given& one : given) known.insert(known.end(), one.groups.begin(), one.groups.end());
  const auto asked = section.some_of({"variants", meaning}, known);
  std::vector<std::string> names;
  for (const Given& one : given) {
    const auto stands_for = [&](const std::string& name) {
      return name == one.name || std::ranges::find(one.groups, name) != one.groups.end();
    };
    if (std::ranges::any_of(asked, stands_for)) names.push_back(one.name);
  }
  return names;
}

std::vector<Given> read_given(Section& root) {
  const std::string scenario = root.text({"scenario", "Scenario file of the variants that name none."}, "");
  const std::vector<Setting> of_all =
      read_set(root, "Keys of the scenarios, with values for all variants that do not set them themselves.");
  std::vector<Given> given;
  for (Section& section : root.tables("variant")) {
    Given one = read_one(section, scenario, of_all);
    if (std::ranges::find(given, one.name, &Given::name) != given.end()) {
      section.reject("name", fmt::format("'{}' is already the name of another variant", one.name),
                     "another name");
    }
    given.push_back(std::move(one));
  }
  for (const Given& one : given) {
    for (const std::string& group : one.groups)
      if (std::ranges::find(given, group, &Given::name) != given.end())
        root.reject("variant", fmt::format("has a group '{}', which is the name of a variant", group),
                    "another name");
  }
  return given;
}

std::vector<Point> read_sweep(Section& root, const std::vector<Given>& given) {
  auto section = root.optional_table({"sweep",
                                      "Keys of the scenario, each with an array of values. Every variant is "
                                      "run with every combination of these values."});
  if (!section) return expand({});
  std::vector<Setting> sweep = section->settings();
  if (sweep.empty()) root.reject("sweep", "is empty", "keys of the scenario, each with an array of values");
  refuse_seed(*section, sweep);
  for (const Setting& key : sweep) {
    if (key.elements.empty()) {
      section->reject(key.key, key.value.starts_with('[') ? "is empty" : "is not an array",
                      "an array of at least one value");
    }
    const auto has_key = [&](const Given& one) {
      return std::ranges::find(one.settings, key.key, &Setting::key) != one.settings.end();
    };
    if (const auto one = std::ranges::find_if(given, has_key); one != given.end()) {
      section->reject(key.key, fmt::format("is set by variant '{}' too", one->name), "one of the two");
    }
  }
  std::uint64_t variants = given.size();
  for (const Setting& key : sweep) {
    variants *= key.elements.size();
    if (variants > most_variants) {
      section->reject(key.key, "makes more variants than can be looked at",
                      fmt::format("at most {} in all", most_variants));
      return {};
    }
  }
  return expand(sweep);
}

std::vector<GivenCheck> read_checks(Section& root, const std::vector<Given>& given,
                                    std::vector<RunCheck>& judged) {
  std::vector<GivenCheck> checks;
  for (Section& section : root.tables("check")) {
    GivenCheck& check = checks.emplace_back();
    check.variants =
        read_variants(section, "Names of the variants, or of groups of them, to judge. Default: all.", given);
    const auto share = section.optional_number(
        {"runs_at_least",
         "Limit: the fraction of the runs that pass the check is at least this value. Needs `name`. Default: "
         "1, which is all runs."},
        scenario::Limits::between(0, 1));
    if (share) judged.push_back({.name = section.text({"name", "Unique name."}), .share_at_least = *share});
    for (const Setting& key : section.settings()) {
      if (key.key == "variants" || key.key == "runs_at_least") continue;
      check.text += fmt::format("{} {} = {}", check.text.empty() ? "{" : ",", key.key, key.value);
    }
    check.text += " }";
  }
  return checks;
}

Result<std::vector<Made>> make_variants(const std::vector<Given>& given, const std::vector<Point>& points,
                                        const Setup& setup) {
  const auto beside = [&](const std::string& name) -> Result<std::string> {
    if (const auto known = setup.sources.scenarios.find(name); known != setup.sources.scenarios.end())
      return known->second;
    auto read = setup.text(name);
    if (read) setup.sources.scenarios.emplace(name, *read);
    return read;
  };
  std::vector<Made> all;
  for (const Given& one : given) {
    for (const Point& point : points) {
      auto made = make_one(one, point, setup, beside);
      std::string why;
      if (!made)
        why = made.error().message;
      else if (setup.with_samples)
        why = why_no_samples(one, made->variant.scenario);
      if (made && why.empty() && std::ranges::any_of(all, [&](const Made& other) {
            return other.variant.name == made->variant.name;
          }))
        why = "is there twice, expected different values in the sweep";
      if (!why.empty())
        return failure(fmt::format("{}:{}: variant '{}': {}", setup.sources.file, one.line,
                                   point.name.empty() ? one.name : fmt::format("{} {}", one.name, point.name),
                                   why));
      all.push_back(std::move(*made));
    }
  }
  return all;
}

}  // namespace canhil::campaign
