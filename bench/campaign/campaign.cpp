#include "bench/campaign/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "bench/drive/contract.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::campaign {
namespace {

namespace fs = std::filesystem;

using scenario::Section;
using scenario::Setting;

/// A variant as written in the file.
struct Given {
  std::string name;
  std::string scenario;
  std::vector<Setting> settings;
  int line = 0;
};

/// A point of the sweep: one value for each key.
struct Point {
  std::string name;
  std::vector<Setting> settings;
};

void refuse_seed(Section& section, const std::vector<Setting>& settings) {
  if (std::ranges::find(settings, "seed", &Setting::key) == settings.end()) return;
  section.reject("seed", "is the same for all variants", "seed at the top of the campaign");
}

Given read_given(Section& section) {
  Given given{.name = section.text({"name", "Unique name."}),
              .scenario = section.text({"scenario", "Scenario file, relative to the campaign file."}),
              .settings = {},
              .line = section.line()};
  if (auto set = section.optional_table(
          {"set", "Keys of the scenario, with values that replace the values in the scenario file."})) {
    given.settings = set->settings();
    refuse_seed(*set, given.settings);
  }
  section.finish();
  return given;
}

std::string without_quotes(std::string_view value) {
  const bool quoted = value.size() >= 2 && (value.front() == '"' || value.front() == '\'');
  return std::string(quoted ? value.substr(1, value.size() - 2) : value);
}

/// Returns all combinations of the sweep's values; the last key varies fastest.
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

std::vector<Setting> read_sweep(Section& root, const std::vector<Given>& given) {
  auto section = root.optional_table({"sweep",
                                      "Keys of the scenario, each with an array of values. Every variant is "
                                      "run with every combination of these values."});
  if (!section) return {};
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
      break;
    }
  }
  return sweep;
}

std::uint64_t hash_of(const Sources& sources) {
  std::string all = fmt::format("{}\n{}", sources.text.size(), sources.text);
  for (const auto& [name, text] : sources.scenarios) {
    all += fmt::format("{}\n{}{}\n{}", name.size(), name, text.size(), text);
  }
  return world::fnv1a_64(all);
}

/// Adds the recordings of the scenarios to the hash. The recordings change the results, but are not part of
/// `Sources`.
std::uint64_t with_recordings(std::uint64_t hash, const std::vector<Variant>& variants) {
  for (const Variant& variant : variants) {
    const std::uint64_t own = variant.scenario.recordings_hash;
    if (own != 0) hash = world::fnv1a_64(fmt::format("{:016x}", own), hash);
  }
  return hash;
}

/// Reads the scenario of each variant at each point of the sweep.
Result<std::vector<Variant>> make_variants(const std::vector<Given>& given, const std::vector<Point>& points,
                                           Sources& sources, const ScenarioText& text, std::uint64_t seed) {
  const auto beside = [&](const std::string& name) -> Result<std::string> {
    if (const auto known = sources.scenarios.find(name); known != sources.scenarios.end())
      return known->second;
    auto read = text(name);
    if (read) sources.scenarios.emplace(name, *read);
    return read;
  };
  std::vector<Variant> variants;
  for (const Given& one : given) {
    for (const Point& point : points) {
      Variant variant{.name = point.name.empty() ? one.name : fmt::format("{} {}", one.name, point.name),
                      .given = one.name,
                      .point = point.name,
                      .scenario = {}};
      std::vector<Setting> settings = one.settings;
      settings.insert(settings.end(), point.settings.begin(), point.settings.end());
      // `one.scenario` is relative to the campaign's folder; paths within the scenario are relative to the
      // scenario.
      const fs::path path = fs::path(sources.file).parent_path() / one.scenario;
      auto read = drive::parse_scenario(sources.scenarios.at(one.scenario), one.scenario, settings,
                                        path.parent_path().string(), beside);
      const auto refused = [&](std::string_view why) {
        return failure(fmt::format("{}:{}: variant '{}': {}", sources.file, one.line, variant.name, why));
      };
      if (!read) return refused(read.error().message);
      for (const estimators::Estimator* estimator : estimators::all()) {
        if (std::string why = scenario::why_no_truth(*read, estimator->facts); !why.empty())
          return refused(fmt::format("{} has {}, expected a truth to compare with", one.scenario, why));
      }
      if (read->targets.size() > 1)
        return refused(
            fmt::format("{} runs {} estimators, expected one", one.scenario, read->targets.size()));
      if (std::ranges::find(variants, variant.name, &Variant::name) != variants.end()) {
        return refused("is there twice, expected different values in the sweep");
      }
      variant.scenario = std::move(*read);
      variant.scenario.seed = seed;
      variants.push_back(std::move(variant));
    }
  }
  return variants;
}

std::vector<Given> read_variants(Section& root) {
  std::vector<Given> given;
  for (Section& section : root.tables("variant")) {
    Given one = read_given(section);
    if (std::ranges::find(given, one.name, &Given::name) != given.end()) {
      section.reject("name", fmt::format("'{}' is already the name of another variant", one.name),
                     "another name");
    }
    given.push_back(std::move(one));
  }
  return given;
}

std::vector<Metric> read_metrics(Section& root, const std::vector<Given>& given, std::int64_t duration_us) {
  std::vector<std::string> names;
  names.reserve(given.size());
  for (const Given& one : given) names.push_back(one.name);
  std::vector<Metric> metrics;
  for (Section& section : root.tables("metric")) {
    Metric metric = read_metric(section, names, duration_us);
    if (std::ranges::find(metrics, metric.name, &Metric::name) != metrics.end()) {
      section.reject("name", fmt::format("'{}' is already the name of another metric", metric.name),
                     "another name");
    }
    metrics.push_back(std::move(metric));
  }
  return metrics;
}

void reject_unreported(Section& root, const Campaign& campaign) {
  for (const Metric& metric : campaign.metrics) {
    const Quantity& quantity = quantity_of(metric);
    for (const std::size_t index : variants_of(campaign, metric)) {
      const Variant& variant = campaign.variants[index];
      if (quantities::has(estimators::of(variant.scenario).layout, quantity)) continue;
      root.reject("metric",
                  fmt::format("'{}' asks for {}, which variant '{}' does not report", metric.name,
                              quantity.name, variant.name),
                  "a quantity of its estimator");
    }
  }
}

}  // namespace

Result<Campaign> parse_campaign(std::string_view text, std::string_view file,
                                const ScenarioText& scenario_text) {
  Section root = Section::parse(text, file);
  Campaign campaign;
  campaign.sources = {.file = std::string(file), .text = std::string(text), .scenarios = {}};
  campaign.title = root.text({"title", "One line, shown in every report."});
  campaign.runs = static_cast<std::uint64_t>(root.integer(
      {"runs",
       fmt::format("Number of runs of each variant, at most {}. The option `--runs` overrides this key.",
                   most_runs)},
      1));
  if (campaign.runs > most_runs)
    root.reject("runs", fmt::format("{} is out of range", campaign.runs),
                fmt::format("at most {}", most_runs));
  campaign.seed = static_cast<std::uint64_t>(
      root.integer({"seed", "Seed of all random numbers, in place of the seeds of the scenarios."}, 0));
  const std::vector<Given> given = read_variants(root);
  const std::vector<Setting> sweep = read_sweep(root, given);
  if (const auto error = root.error()) return tl::unexpected(*error);

  for (const Given& one : given) {
    if (campaign.sources.scenarios.contains(one.scenario)) continue;
    auto scenario = scenario_text(one.scenario);
    if (!scenario) {
      return failure(
          fmt::format("{}:{}: variant '{}': {}", file, one.line, one.name, scenario.error().message));
    }
    campaign.sources.scenarios.emplace(one.scenario, std::move(*scenario));
  }
  auto variants = make_variants(given, expand(sweep), campaign.sources, scenario_text, campaign.seed);
  if (!variants) return tl::unexpected(variants.error());
  campaign.hash = hash_of(campaign.sources);
  campaign.variants = std::move(*variants);
  campaign.hash = with_recordings(campaign.hash, campaign.variants);

  std::int64_t shortest_us = std::numeric_limits<std::int64_t>::max();
  for (const Variant& variant : campaign.variants) {
    shortest_us = std::min(shortest_us, variant.scenario.duration_us);
  }
  if (root.has("metric")) campaign.metrics = read_metrics(root, given, shortest_us);
  reject_unreported(root, campaign);
  root.optional("metric");
  root.finish();
  if (const auto error = root.error()) return tl::unexpected(*error);
  return campaign;
}

Result<Campaign> parse_campaign(const Sources& sources) {
  return parse_campaign(sources.text, sources.file, [&](const std::string& name) -> Result<std::string> {
    const auto found = sources.scenarios.find(name);
    if (found == sources.scenarios.end()) return failure(fmt::format("scenario '{}' is missing", name));
    return found->second;
  });
}

Result<Campaign> read_campaign(const std::filesystem::path& path) {
  const auto text = read_text_file(path, "a campaign file", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse_campaign(*text, path.string(), [&](const std::string& name) {
    return read_text_file(path.parent_path() / name, "a scenario file", scenario::most_toml_bytes);
  });
}

std::vector<CommandFiles::File> inputs_of(const Campaign& campaign) {
  std::vector<CommandFiles::File> files{{"campaign", campaign.sources.file}};
  const fs::path folder = fs::path(campaign.sources.file).parent_path();
  for (const auto& [name, text] : campaign.sources.scenarios)
    files.push_back({"scenario, mapping or DBC", (folder / name).string()});
  for (const Variant& variant : campaign.variants) {
    for (const scenario::InputFile& input : variant.scenario.inputs)
      files.push_back({input.role, input.path});
  }
  return files;
}

std::vector<std::size_t> variants_of(const Campaign& campaign, const Metric& metric) {
  std::vector<std::size_t> chosen;
  const std::string other = other_of(metric);
  for (std::size_t i = 0; i < campaign.variants.size(); ++i) {
    const std::string& name = campaign.variants[i].given;
    const bool wanted = metric.variants.empty()
                            ? name != other  // a variant is not compared with itself
                            : std::ranges::find(metric.variants, name) != metric.variants.end();
    if (wanted) chosen.push_back(i);
  }
  return chosen;
}

std::size_t counterpart(const Campaign& campaign, std::size_t variant, const std::string& other) {
  const auto found = std::ranges::find_if(campaign.variants, [&](const Variant& candidate) {
    return candidate.given == other && candidate.point == campaign.variants[variant].point;
  });
  return static_cast<std::size_t>(found - campaign.variants.begin());
}

}  // namespace canhil::campaign
