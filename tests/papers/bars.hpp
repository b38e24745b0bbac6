// Tests that a campaign meets its acceptance limits ('bars').
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/execute.hpp"
#include "tests/own_folder.hpp"

namespace canhil::papers {

/// Flies the campaign `file` (a path from the root of the project) with `runs` runs or, without this
/// argument, with as many as the file states. Expects that the campaign has exactly `bars` limits and meets
/// all of them, except those of the metrics `of_all_runs`, for which the runs are too few. Returns the
/// results.
inline std::vector<campaign::Answer> expect_bars_met(const std::string& file, std::size_t bars,
                                                     std::optional<std::uint64_t> runs = {},
                                                     const std::vector<std::string>& of_all_runs = {}) {
  auto campaign = campaign::read_campaign(SOURCE_DIR "/" + file);
  if (campaign && runs) campaign->runs = *runs;
  if (!campaign) {
    ADD_FAILURE() << campaign.error().message;
    return {};
  }
  const std::filesystem::path results = std::filesystem::path(test::own_folder()) /
                                        (std::filesystem::path(file).parent_path().filename().string() + "-" +
                                         std::filesystem::path(file).stem().string() + ".sqlite");
  const std::atomic<bool> stop = false;
  campaign::Options options;
  options.file = results;
  const auto ended = campaign::execute(*campaign, options, stop);
  if (!ended) {
    ADD_FAILURE() << ended.error().message;
    return {};
  }
  const auto store = campaign::Store::open(results);
  if (!store) {
    ADD_FAILURE() << store.error().message;
    return {};
  }
  const auto evaluation = campaign::evaluate(*campaign, *store);
  if (!evaluation) {
    ADD_FAILURE() << evaluation.error().message;
    return {};
  }
  std::size_t judged = 0;
  for (const campaign::Answer& answer : evaluation->answers) {
    if (!answer.passed) continue;
    ++judged;
    if (std::ranges::find(of_all_runs, answer.metric) != of_all_runs.end()) continue;
    EXPECT_TRUE(*answer.passed) << answer.requirement << ": " << answer.metric << " (" << answer.variant
                                << "): " << answer.measured << ", expected " << answer.expected;
  }
  EXPECT_EQ(judged, bars);
  return evaluation->answers;
}

}  // namespace canhil::papers
