#include "bench/campaign/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "bench/campaign/variants.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::campaign {
namespace {

namespace fs = std::filesystem;

using scenario::Section;

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

Result<void> add_source(Sources& sources, const std::string& name, const ScenarioText& text) {
  if (sources.scenarios.contains(name)) return {};
  auto read = text(name);
  if (!read) return tl::unexpected(read.error());
  sources.scenarios.emplace(name, std::move(*read));
  return {};
}

/// The checks of the campaign, which replace those of the scenarios; none: the scenarios keep theirs.
std::optional<std::vector<GivenCheck>> read_run_checks(Section& root, const std::vector<Given>& given,
                                                       bool with_faults, Campaign& campaign) {
  std::optional<std::vector<GivenCheck>> checks;
  const bool of_scenarios =
      root.flag({"scenario_checks",
                 "Judges the checks of the scenarios in every run. Not beside `[[check]]` or "
                 "`[faults]`."});
  if (root.has("check")) {
    if (of_scenarios) root.reject("scenario_checks", "has no effect beside [[check]]", "one of the two");
    checks = read_checks(root, given, campaign.checks.emplace());
  } else if (of_scenarios) {
    if (with_faults) root.reject("scenario_checks", "has no effect beside [faults]", "one of the two");
    campaign.checks.emplace();
  }
  root.optional("check");
  return checks;
}

/// [faults] as written in the file.
struct GivenFaults {
  std::string set;  ///< file of the faults; empty: they are drawn
  std::uint64_t seed = 1;
};

std::optional<GivenFaults> read_faults(Section& root) {
  auto section =
      root.optional_table({"faults", "Flies each variant first without a fault, then with each fault."});
  if (!section) return std::nullopt;
  GivenFaults faults;
  faults.set = section->text(
      {"set",
       "File of `[[fault]]` tables, relative to the campaign file: each is a row; those with the same "
       "`together` fly at once. Default: each kind on each node, at times drawn from the seed."},
      "");
  if (!faults.set.empty()) section->refuse("seed", "has no effect beside set", "one of the two");
  faults.seed = static_cast<std::uint64_t>(
      section->optional_integer({"seed", "Of what is drawn. Default: 1."}, 0).value_or(1));
  section->finish();
  return faults;
}

/// Makes a matrix of faults from the variants, whose cells become the variants.
Result<void> add_faults(const GivenFaults& faults, std::vector<Made> made, const ScenarioText& text,
                        Campaign& campaign) {
  const std::string& set = faults.set;
  if (!set.empty()) {
    if (auto added = add_source(campaign.sources, set, text); !added) return added;
  }
  std::vector<matrix::Column> columns;
  for (Made& one : made) columns.push_back(std::move(one.column));
  const fs::path folder = fs::path(campaign.sources.file).parent_path();
  auto matrix = set.empty() ? matrix::drawn_matrix(std::move(columns), faults.seed)
                            : matrix::matrix_of(std::move(columns), campaign.sources.scenarios.at(set),
                                                (folder / set).string());
  if (!matrix) return tl::unexpected(matrix.error());
  std::vector<Variant> variants;
  for (const matrix::Cell& cell : matrix->cells) {
    Variant& variant = variants.emplace_back(campaign.variants[cell.column]);
    variant.fault = cell.row;
    variant.name = fmt::format("{}, {}", variant.name, matrix->rows[cell.row].name());
  }
  if (variants.size() > most_variants)
    return failure(fmt::format("{}: the faults make {} variants, expected at most {}", campaign.sources.file,
                               variants.size(), most_variants));
  campaign.variants = std::move(variants);
  campaign.matrix = std::move(*matrix);
  return {};
}

/// A check that need not pass in every run must be one of the scenarios' checks.
void reject_unknown_checks(Section& root, const Campaign& campaign) {
  if (!campaign.checks) return;
  for (const RunCheck& check : *campaign.checks) {
    const bool known = std::ranges::any_of(campaign.variants, [&](const Variant& variant) {
      return std::ranges::find(variant.scenario.checks, check.name, &scenario::Check::name) !=
             variant.scenario.checks.end();
    });
    if (!known)
      root.reject("check", fmt::format("'{}' is a check of several estimators", check.name),
                  "a check of one estimator, for `runs_at_least`");
  }
}

std::vector<Metric> read_metrics(Section& root, const std::vector<Given>& given, std::int64_t duration_us) {
  std::vector<Metric> metrics;
  for (Section& section : root.tables("metric")) {
    Metric metric = read_metric(section, given, duration_us);
    if (std::ranges::find(metrics, metric.name, &Metric::name) != metrics.end()) {
      section.reject("name", fmt::format("'{}' is already the name of another metric", metric.name),
                     "another name");
    }
    metrics.push_back(std::move(metric));
  }
  return metrics;
}

/// Divides the probability of the limits from sampling distributions among all such limits.
void share_probability(Campaign& campaign) {
  std::size_t sharing = 0;
  for (Metric& metric : campaign.metrics)
    if (sampling_limit_of(metric) != nullptr) sharing += variants_of(campaign, metric).size();
  for (Metric& metric : campaign.metrics)
    if (SamplingLimit* limit = sampling_limit_of(metric)) limit->sharing = sharing;
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
  // Without faults, the number of a run selects its random numbers; with faults, each run has a seed of its
  // own, so that a violation can be saved as a scenario.
  const auto faults = read_faults(root);
  const auto seed = root.optional_integer({"seed",
                                           "Seed of all random numbers, in place of the seeds of the "
                                           "scenarios. With `[faults]` it may be absent: "
                                           "then each scenario has its own seed."},
                                          0);
  if (!seed && !faults) root.missing("seed", "a whole number, at least 0");
  campaign.seed = static_cast<std::uint64_t>(seed.value_or(0));
  const std::vector<Given> given = read_given(root);
  const std::vector<Point> points = read_sweep(root, given);
  const auto checks = read_run_checks(root, given, faults.has_value(), campaign);
  if (const auto error = root.error()) return tl::unexpected(*error);
  for (const Given& one : given) {
    if (auto read = add_source(campaign.sources, one.scenario, scenario_text); !read)
      return failure(fmt::format("{}:{}: variant '{}': {}", file, one.line, one.name, read.error().message));
  }
  auto made = make_variants(given, points,
                            {.sources = campaign.sources,
                             .text = scenario_text,
                             .seed = seed ? std::optional(campaign.seed) : std::nullopt,
                             .checks = checks ? &*checks : nullptr,
                             .with_samples = root.has("metric") || (!faults && !campaign.checks)});
  if (!made) return tl::unexpected(made.error());
  for (const Made& one : *made) campaign.variants.push_back(one.variant);
  if (faults) {
    if (auto added = add_faults(*faults, std::move(*made), scenario_text, campaign); !added)
      return tl::unexpected(added.error());
  }
  campaign.hash = with_recordings(hash_of(campaign.sources), campaign.variants);

  std::int64_t shortest_us = std::numeric_limits<std::int64_t>::max();
  for (const Variant& variant : campaign.variants) {
    shortest_us = std::min(shortest_us, variant.scenario.duration_us);
  }
  if (root.has("metric")) campaign.metrics = read_metrics(root, given, shortest_us);
  share_probability(campaign);
  reject_unreported(root, campaign);
  reject_unknown_checks(root, campaign);
  root.optional("metric");
  root.finish();
  if (const auto error = root.error()) return tl::unexpected(*error);
  return campaign;
}

bool keeps_samples(const Campaign& campaign) {
  return !campaign.metrics.empty() || (!campaign.matrix && !campaign.checks);
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
    files.push_back({"scenario, mapping, DBC or set of faults", (folder / name).string()});
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
    const Variant& own = campaign.variants[variant];
    return candidate.given == other && candidate.point == own.point && candidate.fault == own.fault;
  });
  return static_cast<std::size_t>(found - campaign.variants.begin());
}

}  // namespace canhil::campaign
