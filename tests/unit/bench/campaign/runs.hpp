// Artificial runs for tests, and the text of a short campaign.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/series.hpp"
#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"
#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/estimators/wind/wind.hpp"
#include "tests/own_folder.hpp"

namespace canhil::campaign {

using quantities::Samples;

/// Adds a sample with these numbers, and 0 for all other quantities of its layout.
inline void add(Samples& samples, std::int64_t t_us, const std::map<const Quantity*, double>& given) {
  std::vector<double> values;
  for (const Quantity* quantity : samples.layout().kept)
    values.push_back(given.contains(quantity) ? given.at(quantity) : 0);
  samples.add(t_us, values);
}

/// The layout of transfer alignment if it contains the quantity, otherwise the first layout that contains it.
inline const quantities::Layout& layout_with(const Quantity& quantity) {
  if (quantities::has(estimators::transfer_alignment.layout, quantity))
    return estimators::transfer_alignment.layout;
  const auto found = std::ranges::find_if(
      estimators::all(), [&](const auto* one) { return quantities::has(one->layout, quantity); });
  return (*found)->layout;
}

/// A run with these values of a quantity at 0.1 s, 0.2 s ...
inline RunSeries run_with(std::uint64_t run, const std::vector<double>& values,
                          const Quantity& quantity = quantities::attitude_heading) {
  RunSeries series{.run = run, .ending = {}, .samples = Samples(layout_with(quantity))};
  for (std::size_t i = 0; i < values.size(); ++i)
    add(series.samples, 100'000 * static_cast<std::int64_t>(i + 1), {{&quantity, values[i]}});
  return series;
}

/// A run like that of run_with(), except that the run ended early, at the time of its last value.
inline RunSeries ended_with(std::uint64_t run, const std::vector<double>& values,
                            const Quantity& quantity = quantities::attitude_heading) {
  RunSeries series = run_with(run, values, quantity);
  series.ending = {.kind = drive::Ending::Kind::target_fault,
                   .t_us = 100'000 * static_cast<std::int64_t>(values.size()),
                   .detail = ""};
  return series;
}

/// The values of all updates until the quick flight ends at 3 s. The given values come first; then the last
/// given value is repeated.
inline std::vector<double> held(std::vector<double> values) {
  constexpr std::size_t updates = 30;
  values.resize(updates, values.back());
  return values;
}

inline std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(text).str();
}

/// The path of a file in the folder of this process. If the file exists, it is removed.
inline std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = test::own_folder();
  std::filesystem::remove(folder / name);
  return folder / name;
}

inline std::string quick_scenario() {
  return content(SOURCE_DIR "/bench/flights/transfer_alignment_quick.toml");
}

// Not inline: a constant of another source is made from it, and clang initialises inline constants in the
// order of linking.
const std::string two_variants = R"(title = "Two"
runs = 4
seed = 3
[[variant]]
name = "A"
scenario = "quick.toml"
[[variant]]
name = "B"
scenario = "quick.toml"
set = { "target.initial_sigma.heading_deg" = 1.0 }
)";

/// Reads a campaign whose only scenario is quick.toml.
inline Result<Campaign> parse(const std::string& text) {
  return parse_campaign(text, "c.toml", [](const std::string& name) -> Result<std::string> {
    if (name == "quick.toml") return quick_scenario();
    return failure(name + ": cannot be read");
  });
}

}  // namespace canhil::campaign
