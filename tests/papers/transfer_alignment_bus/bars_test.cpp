// The paper's bars over the bus: the codec with frames quantised, 40 runs. bars.toml says how the bars
// follow.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/execute.hpp"

namespace canhil {
namespace {

TEST(TransferAlignmentPaperOverTheBus, MeetsTheBarsWith40Runs) {
  const auto campaign = campaign::read_campaign(SOURCE_DIR "/tests/papers/transfer_alignment_bus/bars.toml");
  ASSERT_TRUE(campaign) << campaign.error().message;
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "transfer_alignment_bus.sqlite";
  std::filesystem::remove(file);
  const std::atomic<bool> stop = false;
  campaign::Options options;
  options.file = file;
  const auto ended = campaign::execute(*campaign, options, stop);
  ASSERT_TRUE(ended) << ended.error().message;
  const auto store = campaign::Store::open(file);
  ASSERT_TRUE(store) << store.error().message;
  const auto evaluation = campaign::evaluate(*campaign, *store);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  constexpr std::size_t bars = 9;
  ASSERT_EQ(evaluation->answers.size(), bars);
  for (const campaign::Answer& answer : evaluation->answers) {
    EXPECT_TRUE(answer.passed.value_or(false)) << answer.requirement << ": " << answer.metric << ": "
                                               << answer.measured << ", expected " << answer.expected;
  }
}

}  // namespace
}  // namespace canhil
