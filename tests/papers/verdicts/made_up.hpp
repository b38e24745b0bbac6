// Artificial results of a paper's campaigns: a test sets every value, and no run is flown.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/store.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/papers/page_content.hpp"
#include "tests/own_folder.hpp"

namespace canhil::papers {

struct Paper {
  std::string name;
  const EmbeddedFiles &campaigns, &scenarios;
  Result<PageContent> (*page_content)(const Results& results, const FlyOptions& options,
                                      const std::filesystem::path& exact);
};
inline const std::vector<Paper> papers{
    {"transfer", transfer_alignment::campaigns, transfer_alignment::scenarios,
     transfer_alignment::page_content},
    {"inflight", inflight_alignment::campaigns, inflight_alignment::scenarios,
     inflight_alignment::page_content},
    {"los", los_rate::campaigns, los_rate::scenarios, los_rate::page_content},
    {"wind", wind::campaigns, wind::scenarios, wind::page_content}};

inline constexpr std::uint64_t runs_of_each = 2;

inline campaign::Campaign read(const Paper& paper, const EmbeddedFile& file) {
  auto campaign = campaign::parse_campaign(file.text, fmt::format("{}.toml", file.name),
                                           [&](const std::string& name) -> Result<std::string> {
                                             for (const EmbeddedFile& scenario : paper.scenarios)
                                               if (name == fmt::format("{}.toml", scenario.name))
                                                 return std::string(scenario.text);
                                             return failure(name);
                                           });
  if (!campaign) throw std::runtime_error(campaign.error().message);
  campaign->runs = runs_of_each;
  return std::move(*campaign);
}

/// A run in which every quantity is constant: its value is `value`, in the unit in which reports print the
/// quantity.
inline campaign::RunSeries run_at(const campaign::Variant& variant, std::uint64_t run, double value) {
  const quantities::Layout& layout = estimators::of(variant.scenario).layout;
  campaign::RunSeries series{.run = run, .ending = {}, .samples = quantities::Samples(layout)};
  std::vector<double> values;
  for (const quantities::Quantity* quantity : layout.kept) values.push_back(value * quantity->unit.factor);
  const std::int64_t of_answers_us = 500'000, end_us = variant.scenario.duration_us;
  const std::int64_t step_us = layout.to_go_stretch_us > 0 ? layout.to_go_stretch_us : of_answers_us;
  const std::int64_t from_us = layout.to_go_stretch_us > 0 ? -end_us : step_us;
  const std::int64_t to_us = layout.to_go_stretch_us > 0 ? 0 : end_us;
  for (std::int64_t t_us = from_us; t_us <= to_us; t_us += step_us) series.samples.add(t_us, values);
  return series;
}

/// Values by variant; a variant that is not listed has the value 1.
using Values = std::map<std::string, double>;

inline campaign::Load load_at(const campaign::Campaign& campaign, const Values& values) {
  return [&campaign, values](std::size_t variant) -> Result<std::vector<campaign::RunSeries>> {
    const auto named = values.find(campaign.variants[variant].name);
    std::vector<campaign::RunSeries> runs;
    for (std::uint64_t run = 0; run < runs_of_each; ++run)
      runs.push_back(run_at(campaign.variants[variant], run, named == values.end() ? 1 : named->second));
    return runs;
  };
}

inline std::vector<campaign::Answer> answers_at(const campaign::Campaign& campaign, const Values& values) {
  auto evaluation = campaign::evaluate(campaign, load_at(campaign, values));
  if (!evaluation) throw std::runtime_error(evaluation.error().message);
  return std::move(evaluation->answers);
}

/// The results of all campaigns of a paper: every figure is 1, no run is missing, every limit is met. Tests
/// change these results.
class MadeUp {
 public:
  explicit MadeUp(const Paper& paper) : paper_(paper) {
    options_.folder = std::filesystem::path(test::own_folder()) / paper.name;
    std::filesystem::remove_all(options_.folder);
    std::filesystem::create_directories(options_.folder);
    for (const EmbeddedFile& file : paper.campaigns) {
      Flown flown{.name = std::string(file.name), .campaign = read(paper, file), .evaluation = {}};
      flown.evaluation.answers = answers_at(flown.campaign, {});
      for (campaign::Answer& answer : flown.evaluation.answers) {
        if (answer.passed) answer.passed = true;
        for (auto& [figure, value] : answer.figures) value = figure == "missing" ? 0 : 1;
      }
      results.campaigns.push_back(std::move(flown));
    }
    // The files of these campaigns are needed, because the page reads the curves of single runs from them.
    for (const char* name : {"table2", "ssbl", "gps"})
      if (const Flown* flown = find(name)) store(*flown);
    // The page on in-flight alignment has a limit that no campaign contains: the median error of the UKF must
    // be smaller than that of the EKF. So the EKF gets 2, and the UKF keeps 1.
    for (const char* aid : {"ssbl", "gps"})
      if (find(aid) != nullptr) set(aid, "heading at 300 s", "ekf_90", "median_deg", 2);
  }
  MadeUp(const MadeUp&) = delete;
  MadeUp& operator=(const MadeUp&) = delete;
  ~MadeUp() { std::filesystem::remove_all(options_.folder); }

  campaign::Answer& answer(std::string_view campaign, std::string_view metric, std::string_view variant) {
    for (Flown& flown : results.campaigns) {
      if (flown.name != campaign) continue;
      for (campaign::Answer& one : flown.evaluation.answers)
        if (one.metric == metric && one.variant == variant) return one;
    }
    throw std::runtime_error(fmt::format("{}: no '{}' of '{}'", campaign, metric, variant));
  }
  void set(std::string_view campaign, std::string_view metric, std::string_view variant,
           std::string_view figure, double value) {
    for (auto& [name, now] : answer(campaign, metric, variant).figures) {
      if (name != figure) continue;
      now = value;
      return;
    }
    throw std::runtime_error(fmt::format("no figure '{}'", figure));
  }
  [[nodiscard]] PageContent content() const {
    auto content = paper_.page_content(results, options_, {});
    if (!content) throw std::runtime_error(content.error().message);
    return std::move(*content);
  }
  [[nodiscard]] bool bars_met() const { return content().bars_met; }
  [[nodiscard]] bool holds(std::string_view claim) const {
    const PageContent all = content();
    Words none("");
    return std::get<bool>(all.names.find(claim)->second(none));
  }

  Results results;

 private:
  [[nodiscard]] const Flown* find(std::string_view name) const {
    const auto found = std::ranges::find(results.campaigns, name, &Flown::name);
    return found == results.campaigns.end() ? nullptr : &*found;
  }
  void store(const Flown& flown) const {
    auto store = campaign::Store::create(results_file(options_, flown.name),
                                         campaign::identity_of(flown.campaign), flown.campaign.sources);
    if (!store) throw std::runtime_error(store.error().message);
    std::vector<campaign::Finished> all;
    for (std::size_t variant = 0; variant < flown.campaign.variants.size(); ++variant)
      for (std::uint64_t run = 0; run < runs_of_each; ++run)
        all.push_back({.variant = variant, .series = run_at(flown.campaign.variants[variant], run, 1)});
    if (auto added = store->add(all); !added) throw std::runtime_error(added.error().message);
    store->close();
  }

  const Paper& paper_;
  FlyOptions options_{};
};

}  // namespace canhil::papers
