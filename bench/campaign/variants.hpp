// Reads the variants of a campaign: scenarios with other values, at each point of a sweep.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::campaign {

/// A variant as written in the file.
struct Given {
  std::string name;
  std::string scenario{};
  std::vector<std::string> groups{};
  std::vector<scenario::Setting> settings{};  ///< of all variants, and its own, which replace them
  int line = 0;
};
std::vector<Given> read_given(scenario::Section& root);
std::vector<std::string> names_of(const std::vector<Given>& given);
/// Reads the key `variants`, which names variants or groups. Returns the names of the variants.
std::vector<std::string> read_variants(scenario::Section& section, std::string_view meaning,
                                       const std::vector<Given>& given);

/// A point of the sweep: one value for each key.
struct Point {
  std::string name;
  std::vector<scenario::Setting> settings;
};
/// All combinations of the sweep's values; the last key varies fastest. Without a sweep: one point without
/// values.
std::vector<Point> read_sweep(scenario::Section& root, const std::vector<Given>& given);

/// A [[check]] of the campaign, as an inline table for its scenarios.
struct GivenCheck {
  std::string text;
  std::vector<std::string> variants;  ///< empty: all
};
/// The checks of the campaign. `judged` receives the shares of those that need not pass in every run.
std::vector<GivenCheck> read_checks(scenario::Section& root, const std::vector<Given>& given,
                                    std::vector<RunCheck>& judged);

/// What the scenarios of the variants are read with.
struct Setup {
  Sources& sources;  ///< receives the mappings and DBCs that the scenarios use
  const ScenarioText& text;
  std::optional<std::uint64_t> seed;      ///< none: each scenario has its own
  const std::vector<GivenCheck>* checks;  ///< of the campaign; null: those of the scenarios stay
  bool with_samples;                      ///< false: a scenario may run several estimators, and need no truth
};
/// A variant and, for a matrix of faults, its column.
struct Made {
  Variant variant;
  matrix::Column column;
};
/// Reads the scenario of each variant at each point of the sweep. Error: one line.
Result<std::vector<Made>> make_variants(const std::vector<Given>& given, const std::vector<Point>& points,
                                        const Setup& setup);

}  // namespace canhil::campaign
