// All four estimators at once: each sends the same answers as when it runs alone.
#include <gtest/gtest.h>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/estimators/wind/answers.hpp"

namespace canhil::drive {
namespace {

// Flies in lockstep, so that the other estimators add only their heartbeats.
Collected fly(const scenario::Scenario& scenario) {
  const auto truth = make_truth(scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto flown = run_in_process(scenario, *truth, 0);
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  return std::move(*flown);
}

void expect_same(const auto& together, const auto& alone, auto&&... members) {
  ASSERT_GT(together.size(), 30U);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
    ASSERT_TRUE(((together[i].*members == alone[i].*members) && ...)) << "answer " << i;
}

TEST(SeveralEstimators, AnswerAsTheyDoAlone) {
  const auto all = scenario::read_file(SOURCE_DIR "/bench/flights/all_four.toml", contract());
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ(all->targets.size(), 4U);
  const checks::Observations together = fly(*all).seen;
  for (const scenario::TargetSetup& target : all->targets) {
    SCOPED_TRACE(target.estimator);
    scenario::Scenario one = *all;
    one.targets = {target};
    const checks::Observations alone = fly(one).seen;
    if (target.estimator == "transfer_alignment") {
      expect_same(together.of<estimators::TransferAnswers>().navigation,
                  alone.of<estimators::TransferAnswers>().navigation, &estimators::NavigationAnswer::cause_us,
                  &estimators::NavigationAnswer::v_eb_n);
      expect_same(together.of<estimators::TransferAnswers>().filter,
                  alone.of<estimators::TransferAnswers>().filter, &estimators::FilterAnswer::cause_us,
                  &estimators::FilterAnswer::nis, &estimators::FilterAnswer::attitude_sigma);
    } else if (target.estimator == "inflight_alignment") {
      expect_same(together.of<estimators::InflightAnswers>().navigation,
                  alone.of<estimators::InflightAnswers>().navigation, &estimators::NavigationAnswer::cause_us,
                  &estimators::NavigationAnswer::v_eb_n);
      expect_same(together.of<estimators::InflightAnswers>().fixes,
                  alone.of<estimators::InflightAnswers>().fixes, &estimators::FixAnswer::cause_us,
                  &estimators::FixAnswer::nis, &estimators::FixAnswer::attitude_sigma);
    } else if (target.estimator == "los_rate") {
      expect_same(together.of<estimators::LosAnswers>(), alone.of<estimators::LosAnswers>(),
                  &estimators::LosAnswer::cause_us, &estimators::LosAnswer::nis,
                  &estimators::LosAnswer::rate);
    } else {
      expect_same(together.of<estimators::WindAnswers>(), alone.of<estimators::WindAnswers>(),
                  &estimators::WindAnswer::cause_us, &estimators::WindAnswer::nis,
                  &estimators::WindAnswer::wind_n);
    }
  }
}

}  // namespace
}  // namespace canhil::drive
