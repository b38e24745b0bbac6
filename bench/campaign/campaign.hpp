// Reads and validates a campaign file. The file contains variants of scenarios, faults with which each of
// them is flown, and what is judged: metrics over all runs, checks of each run, responses to the faults. All
// variants are flown with the same seed and run indices. Run r therefore has the same random numbers in every
// variant, so that runs of two variants can be compared in pairs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/matrix/matrix.hpp"
#include "bench/campaign/metric.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::campaign {

/// A scenario with its settings at one point of the sweep, and with a fault if the campaign has faults.
struct Variant {
  std::string name;   ///< unique: the name in the file; followed by the point of a sweep, and by the fault
  std::string given;  ///< name in the campaign file
  std::string point;  ///< for example "master_ins.period_ms=50 ..."; empty without a sweep
  scenario::Scenario scenario;  ///< in a campaign with faults: as in its file, without the fault
  std::size_t fault = 0;        ///< row of Campaign::matrix; 0: none
};

/// A check that is judged in every run of some variants.
struct RunCheck {
  std::string name;           ///< as Check::name in the scenarios
  double share_at_least = 1;  ///< of the runs that must pass it
};

/// The texts from which a campaign was read. With these texts, stored results can be evaluated without the
/// files.
struct Sources {
  std::string file;  ///< file name as given by the user
  std::string text;
  /// The texts of the scenario files, of the mappings and DBCs that the scenarios use, and of the set of
  /// faults. The key of a text is the file name by which the campaign or the scenario refers to the file.
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
  /// If not none, the checks of the scenarios are judged in every run; those that need not pass in all runs.
  std::optional<std::vector<RunCheck>> checks{};
  std::optional<matrix::Matrix> matrix{};       ///< the variants are its cells; none: no faults
  Rounding rounding = Rounding::as_on_the_bus;  ///< set by the command line, not by the file
};

/// Whether the results of a run contain the samples of its quantities.
bool keeps_samples(const Campaign& campaign);

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
/// The index of the variant named `other` at the same sweep point and with the same fault as `variant`.
std::size_t counterpart(const Campaign& campaign, std::size_t variant, const std::string& other);

}  // namespace canhil::campaign
