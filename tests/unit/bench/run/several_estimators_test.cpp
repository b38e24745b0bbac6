// All four estimators at once: each gives the answers that it gives alone.
#include <gtest/gtest.h>

#include "bench/run/contract.hpp"
#include "bench/run/flight.hpp"
#include "bench/run/session.hpp"

namespace canhil::run {
namespace {

// In lockstep, so that the heartbeats of neighbours are the only difference.
Collected fly(const scenario::Scenario& scenario) {
  const auto truth = make_truth(scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto flown = run_in_process(scenario, *truth, 0);
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  return std::move(*flown);
}

template <class Answer>
void expect_same(const std::vector<Answer>& together, const std::vector<Answer>& alone, auto&&... members) {
  ASSERT_GT(together.size(), 30U);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
    ASSERT_TRUE(((together[i].*members == alone[i].*members) && ...)) << "answer " << i;
}

TEST(SeveralEstimators, AnswerAsTheyDoAlone) {
  const auto all = scenario::read_file(SOURCE_DIR "/bench/scenarios/all_four.toml", contract());
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ(all->targets.size(), 4U);
  const checks::Observations together = fly(*all).seen;
  for (const scenario::TargetSetup& target : all->targets) {
    SCOPED_TRACE(target.estimator);
    scenario::Scenario one = *all;
    one.targets = {target};
    const checks::Observations alone = fly(one).seen;
    if (target.estimator == "transfer_alignment") {
      expect_same(together.navigation, alone.navigation, &checks::NavigationAnswer::cause_us,
                  &checks::NavigationAnswer::v_eb_n);
      expect_same(together.filter, alone.filter, &checks::FilterAnswer::cause_us, &checks::FilterAnswer::nis,
                  &checks::FilterAnswer::attitude_sigma);
    } else if (target.estimator == "inflight_alignment") {
      expect_same(together.fix_navigation, alone.fix_navigation, &checks::NavigationAnswer::cause_us,
                  &checks::NavigationAnswer::v_eb_n);
      expect_same(together.fixes, alone.fixes, &checks::FixAnswer::cause_us, &checks::FixAnswer::nis,
                  &checks::FixAnswer::heading_sigma);
    } else if (target.estimator == "los_rate") {
      expect_same(together.los, alone.los, &checks::LosAnswer::cause_us, &checks::LosAnswer::nis,
                  &checks::LosAnswer::rate);
    } else {
      expect_same(together.wind, alone.wind, &checks::WindAnswer::cause_us, &checks::WindAnswer::nis,
                  &checks::WindAnswer::wind_n);
    }
  }
}

}  // namespace
}  // namespace canhil::run
