#include "bench/campaign/flights.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/campaign/judged.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/judged.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/world/stoppable.hpp"

namespace canhil::campaign {
namespace {

// The results of a run that was flown with a verdict.
RunSeries series_of(const Key& key, const drive::Run& run, const scenario::Scenario& scenario,
                    bool with_samples) {
  RunSeries series{.run = key.run, .ending = run.ending};
  if (with_samples)
    series.samples = samples_of(run.seen, run.per_run_truth, run.truth, estimators::of(scenario));
  return series;
}

}  // namespace

Result<scenario::Scenario> scenario_of(const Campaign& campaign, const Key& key) {
  if (!campaign.matrix) return campaign.variants[key.variant].scenario;
  const matrix::Cell& cell = campaign.matrix->cells[key.variant];
  return matrix::scenario_of(campaign.matrix->columns[cell.column], key.run,
                             campaign.matrix->faults_of(cell, key.run));
}

Flights::Flights(const Campaign& campaign, const std::string& target, const std::filesystem::path& folder,
                 const std::atomic<bool>& stop)
    : campaign_(campaign), target_(target), stop_(stop) {
  if (campaign.matrix) with_faults_.emplace(*campaign.matrix, target, folder, stop);
}

Result<void> Flights::prepare(std::span<const Key> runs) {
  if (with_faults_ || campaign_.checks) return {};  // such a run makes its own truth
  const world::Stoppable stoppable(stop_);
  truths_.resize(campaign_.variants.size());
  for (const Key& key : runs) {
    if (stop_) return {};
    if (truths_[key.variant]) continue;
    auto truth = drive::make_truth(campaign_.variants[key.variant].scenario);
    if (stop_) return {};
    if (!truth) return tl::unexpected(in_variant(key.variant, truth.error()));
    truths_[key.variant] = std::move(*truth);
  }
  return {};
}

Result<std::optional<Finished>> Flights::fly(const Key& key) {
  auto flown = with_faults_ ? respond(key) : campaign_.checks ? judge(key) : observe(key);
  if (stop_) return std::nullopt;  // even if this run was completed, or failed because of the interruption
  return flown;
}

Error Flights::in_variant(std::size_t variant, const Error& error) const {
  return {fmt::format("{}: variant '{}': {}", campaign_.sources.file, campaign_.variants[variant].name,
                      error.message)};
}

Result<std::optional<Finished>> Flights::observe(const Key& key) const {
  const scenario::Scenario& scenario = campaign_.variants[key.variant].scenario;
  const world::FlightRecord& truth = *truths_[key.variant];
  const auto flown = drive::observe_run(scenario, truth, key.run,
                                        drive::unattended(target_, scenario, campaign_.rounding), stop_);
  if (!flown) return tl::unexpected(in_variant(key.variant, flown.error()));
  return Finished{
      .variant = key.variant,
      .series = {.run = key.run,
                 .ending = flown->ending,
                 .samples = samples_of(flown->seen, flown->per_run_truth, truth, estimators::of(scenario))}};
}

Result<std::optional<Finished>> Flights::judge(const Key& key) const {
  const scenario::Scenario& scenario = campaign_.variants[key.variant].scenario;
  drive::Options options = drive::unattended(target_, scenario, campaign_.rounding);
  options.run_index = key.run;
  const auto flown = drive::run(scenario, options, stop_, [](std::int64_t) {});
  if (!flown) return tl::unexpected(in_variant(key.variant, flown.error()));
  Finished finished{.variant = key.variant,
                    .series = series_of(key, *flown, scenario, keeps_samples(campaign_))};
  finished.series.ending = drive::ending_as_a_run(flown->ending, scenario, flown->seen, flown->per_run_truth);
  finished.series.judged = to_text({.checks = flown->verdict.checks});
  return finished;
}

Result<std::optional<Finished>> Flights::respond(const Key& key) {
  const auto flown = with_faults_->fly(campaign_.matrix->cells[key.variant], key.run,
                                       static_cast<std::size_t>(row_id(key, campaign_.runs)));
  if (!flown) return tl::unexpected(in_variant(key.variant, flown.error()));
  if (!*flown) return std::nullopt;
  const matrix::Flown& one = **flown;
  Finished finished{.variant = key.variant,
                    .series = series_of(key, one.run, one.scenario, keeps_samples(campaign_))};
  finished.series.judged = to_text({.checks = {}, .response = one.result});
  return finished;
}

}  // namespace canhil::campaign
