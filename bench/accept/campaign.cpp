#include "bench/accept/campaign.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "bench/accept/item.hpp"
#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/execute.hpp"
#include "dbc/files/output_file.hpp"

namespace canhil::accept {
namespace {

namespace fs = std::filesystem;
using checks::Outcome;
using Items = std::vector<Item>;

constexpr const char* all_runs = "all runs to their end";

// The requirement of a campaign's runs: that of its first metric or check.
std::string requirement_of(const campaign::Campaign& campaign) {
  if (!campaign.metrics.empty()) return campaign.metrics.front().requirement;
  const auto& checks = campaign.variants.front().scenario.checks;
  return checks.empty() ? "" : checks.front().requirement;
}

void leave_unjudged(const campaign::Campaign& campaign, const std::string& name, Items& items) {
  for (const campaign::Metric& metric : campaign.metrics) {
    if (metric.requirement.empty() || metric.requirement == requirement_of(campaign)) continue;
    Item left = item(metric.requirement, fmt::format("{}: {}", name, metric.name), "", all_runs);
    left.outcome = Outcome::not_measured;
    left.measured = "the campaign ended early";
    items.push_back(std::move(left));
  }
}

Result<void> judge(const campaign::Campaign& campaign, const std::string& name, const fs::path& file,
                   Items& items) {
  const auto store = campaign::Store::open(file);
  if (!store) return tl::unexpected(store.error());
  const auto evaluation = campaign::evaluate(campaign, *store);
  if (!evaluation) return tl::unexpected(evaluation.error());
  for (const campaign::Endings& ending : evaluation->endings) {
    if (ending.completed == ending.runs && ending.not_finite == 0) continue;
    items.push_back(item(requirement_of(campaign), fmt::format("{}: {}", name, ending.variant),
                         fmt::format("{} of {} runs completed, {} with values that are not numbers; {}",
                                     ending.completed, ending.runs, ending.not_finite, ending.first_fault),
                         all_runs));
  }
  for (const campaign::Answer& answer : evaluation->answers) {
    const auto outcome = answer.outcome();
    if (!outcome) continue;
    items.push_back(
        {.name = fmt::format("{}: {}", name, answer.metric),
         .kind = answer.kind,
         .requirement = answer.requirement.empty() ? requirement_of(campaign) : answer.requirement,
         .outcome = *outcome,
         .measured = answer.measured,
         .expected = answer.expected,
         .judgement = answer.judgement});
  }
  return {};
}

}  // namespace

Result<std::vector<std::string>> tested_by_campaign(const Suite& suite, const std::string& name) {
  const auto campaign = campaign::read_campaign(suite.folder / name);
  if (!campaign) return tl::unexpected(campaign.error());
  std::vector<std::string> ids;
  for (const campaign::Metric& metric : campaign->metrics) ids.push_back(metric.requirement);
  for (const campaign::Variant& variant : campaign->variants) {
    for (const scenario::Check& check : variant.scenario.checks) ids.push_back(check.requirement);
  }
  return ids;
}

Result<std::vector<Item>> fly_campaign(const Suite& suite, const std::string& name, const Options& asked,
                                       const std::atomic<bool>& stop) {
  auto campaign = campaign::read_campaign(suite.folder / name);
  if (!campaign) return tl::unexpected(campaign.error());
  if (asked.seed) {
    for (campaign::Variant& variant : campaign->variants) variant.scenario.seed = *asked.seed;
  }
  std::error_code no_folder;
  const fs::path folder = fs::temp_directory_path(no_folder);
  if (no_folder) return failure("environment TMPDIR: expected a folder, for the results of campaigns");
  const auto results = OutputFile::create((folder / "canhil-accept").string());  // removed at the end
  if (!results) return tl::unexpected(results.error());
  const std::string& file = results->temporary_name();
  campaign::Options options;
  options.file = file;
  options.resume = true;  // the file exists, without content
  options.target = asked.target;
  options.threads = asked.threads;
  options.progress = [&](const campaign::Progress& progress) {
    asked.progress(fmt::format("{}: {} {} / {} runs", suite.estimator, name, progress.done, progress.total));
  };
  Items items;
  options.not_flown = [&](const Error& why) {
    if (requirement_of(*campaign).empty()) return;
    items.push_back(item(requirement_of(*campaign), fmt::format("campaign {}", name), why.message, all_runs));
  };
  const auto flown = campaign::execute(*campaign, options, stop);
  if (!flown && items.empty()) return tl::unexpected(flown.error());
  if (flown && *flown == campaign::Execution::complete) {
    if (auto judged = judge(*campaign, name, file, items); !judged) return tl::unexpected(judged.error());
  } else if (!stop) {
    leave_unjudged(*campaign, name, items);
  }
  return items;
}

}  // namespace canhil::accept
