// A campaign file, read and validated: variants of scenarios, all flown with the same seed and run indices,
// and what is asked of them. Run r has the same random numbers in every variant: runs are paired.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/metric.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::campaign {

/// A scenario with its settings, at one point of the sweep.
struct Variant {
  std::string name;   ///< unique: that of the file, with the point of the sweep if there is one
  std::string given;  ///< as named in the file
  std::string point;  ///< "master_ins.period_ms=50 ..."; empty without a sweep
  scenario::Scenario scenario;
};

/// The texts that a campaign was read from: with them, results can be read where the files are not.
struct Sources {
  std::string file;  ///< as it was named
  std::string text;
  /// Text by name as written in the campaign; mappings and DBCs that a scenario names are there too.
  std::map<std::string, std::string> scenarios;
};

/// Of one campaign: its list of runs stays in memory.
inline constexpr std::uint64_t most_runs = 10'000'000;
/// Each is a scenario of its own, read before the first run.
inline constexpr std::uint64_t most_variants = 10'000;

struct Campaign {
  Sources sources;
  std::uint64_t hash = 0;  ///< of all texts: results of equal hash belong together
  std::string title;
  std::uint64_t runs = 0;
  std::uint64_t seed = 0;
  std::vector<Variant> variants;  ///< in the order of the file, then of the sweep
  std::vector<Metric> metrics;
  Rounding rounding = Rounding::as_on_the_bus;  ///< not of the file: what a run of it is told
};

/// Reads a campaign file and its scenarios. The error is one line.
Result<Campaign> read_campaign(const std::filesystem::path& path);

/// Gives the text of a scenario by its name as written in the campaign.
using ScenarioText = std::function<Result<std::string>(const std::string&)>;
/// Reads a campaign's text; `file` stands for it in messages.
Result<Campaign> parse_campaign(std::string_view text, std::string_view file,
                                const ScenarioText& scenario_text);

/// A campaign from texts that were kept with its results.
Result<Campaign> parse_campaign(const Sources& sources);

/// The variants that a metric speaks of.
std::vector<std::size_t> variants_of(const Campaign& campaign, const Metric& metric);
/// The variant given as `other` at the same point of the sweep as `variant`.
std::size_t counterpart(const Campaign& campaign, std::size_t variant, const std::string& other);

}  // namespace canhil::campaign
