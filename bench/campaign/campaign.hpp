// Reads and validates a campaign file. The file contains variants of scenarios, and metrics. All variants are
// flown with the same seed and run indices. Run r therefore has the same random numbers in every variant, so
// that runs of two variants can be compared in pairs.
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
#include "dbc/files/command_files.hpp"
#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::campaign {

/// A scenario with its settings at one point of the sweep.
struct Variant {
  std::string name;   ///< unique: the name in the file; with a sweep, followed by the point
  std::string given;  ///< name in the campaign file
  std::string point;  ///< for example "master_ins.period_ms=50 ..."; empty without a sweep
  scenario::Scenario scenario;
};

/// The texts from which a campaign was read. With these texts, stored results can be evaluated without the
/// files.
struct Sources {
  std::string file;  ///< file name as given by the user
  std::string text;
  /// The texts of the scenario files, and of the mappings and DBCs that the scenarios use. The key of a text
  /// is the file name by which the campaign or the scenario refers to the file.
  std::map<std::string, std::string> scenarios;
};

/// The largest number of runs in a campaign. The limit exists because the list of runs is kept in memory.
inline constexpr std::uint64_t most_runs = 10'000'000;
/// The largest number of variants in a campaign. The limit exists because the scenarios of all variants are
/// read before the first run.
inline constexpr std::uint64_t most_variants = 10'000;

struct Campaign {
  Sources sources;
  std::uint64_t hash = 0;  ///< hash of all texts and recordings, equal for results of the same campaign
  std::string title;
  std::uint64_t runs = 0;
  std::uint64_t seed = 0;
  std::vector<Variant> variants;  ///< ordered as in the file; for each, ordered as in the sweep
  std::vector<Metric> metrics;
  Rounding rounding = Rounding::as_on_the_bus;  ///< set by the command line, not by the file
};

/// Reads a campaign file and its scenarios. An Error has one line.
Result<Campaign> read_campaign(const std::filesystem::path& path);

/// Returns the text of a scenario by its name in the campaign.
using ScenarioText = std::function<Result<std::string>(const std::string&)>;
/// Reads a campaign's text; `file` is its name in messages.
Result<Campaign> parse_campaign(std::string_view text, std::string_view file,
                                const ScenarioText& scenario_text);

/// Reads a campaign from the texts that were stored with its results.
Result<Campaign> parse_campaign(const Sources& sources);

/// The files that a campaign reads: itself, its scenarios, their mappings, DBCs and recordings.
std::vector<CommandFiles::File> inputs_of(const Campaign& campaign);

/// The indices of the variants to which a metric applies.
std::vector<std::size_t> variants_of(const Campaign& campaign, const Metric& metric);
/// The index of the variant named `other` at the same sweep point as `variant`.
std::size_t counterpart(const Campaign& campaign, std::size_t variant, const std::string& other);

}  // namespace canhil::campaign
