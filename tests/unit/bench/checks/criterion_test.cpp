// Judgements in numbers: margins, and the numbers of checks whose values are known by hand.
#include "bench/checks/criterion.hpp"

#include <gmock/gmock.h>

#include <array>

#include "bench/checks/kinds/bus_load.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/quantities/list.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::checks {
namespace {

Judgement judgement_of(std::optional<double> value, std::optional<Limit> lower, std::optional<Limit> upper) {
  return {.criterion = {.lower = lower, .upper = upper, .unit = "mrad"}, .measurement = {.value = value}};
}

TEST(Margin, IsTheDistanceToTheNearestLimitAsAShareOfIt) {
  EXPECT_DOUBLE_EQ(*margin(judgement_of(1.5, {}, exclusive(2))), 0.25);
  EXPECT_DOUBLE_EQ(*margin(judgement_of(3, {}, exclusive(2))), -0.5) << "beyond it";
  EXPECT_DOUBLE_EQ(*margin(judgement_of(1.25, Limit{1}, {})), 0.25);
  EXPECT_DOUBLE_EQ(*margin(judgement_of(1.75, Limit{1}, Limit{2})), 0.125);
  EXPECT_DOUBLE_EQ(*margin(judgement_of(1.25, Limit{1}, Limit{2})), 0.25);
  EXPECT_DOUBLE_EQ(*margin(judgement_of(-1.5, Limit{-2}, {})), 0.25) << "of a negative limit";
}

TEST(Margin, OfNoValueNoLimitOrTheLimit0IsNone) {
  EXPECT_FALSE(margin(judgement_of({}, {}, Limit{2})));
  EXPECT_FALSE(margin(judgement_of(1, {}, {})));
  EXPECT_FALSE(margin(judgement_of(0, {}, Limit{0})));
  EXPECT_FALSE(margin(judgement_of(-1, Limit{0}, Limit{2}))) << "beyond 0, however far from the other limit";
  EXPECT_DOUBLE_EQ(*margin(judgement_of(1, Limit{0}, Limit{2})), 0.5) << "within 0: the other limit counts";
}

TEST(Criterion, SaysItsLimits) {
  EXPECT_EQ(to_text(judgement_of({}, {}, exclusive(2.3)).criterion), "< 2.3 mrad");
  EXPECT_EQ(to_text(judgement_of({}, Limit{1.6}, Limit{2.4}).criterion), ">= 1.6 and <= 2.4 mrad");
  EXPECT_EQ(to_text(judgement_of({}, exclusive(0), {}).criterion), "> 0 mrad");
  EXPECT_EQ(to_text(Criterion{.upper = Limit{3}}), "<= 3");
  EXPECT_EQ(to_text(Criterion{}), "");
}

TEST(Finding, OfSeveralValuesTakesTheNumbersOfTheNearestToItsLimit) {
  const auto taken = [](std::vector<Judgement> judgements) {
    Finding finding;
    take_nearest_to_limit(finding, std::move(judgements));
    return finding.measurement.value;
  };
  const Judgement far = judgement_of(1, {}, Limit{4}), near = judgement_of(3, {}, Limit{4});
  const Judgement at_0 = judgement_of(0, {}, Limit{0}), beyond_0 = judgement_of(7, {}, Limit{0});
  EXPECT_EQ(taken({far, near}), 3);
  EXPECT_EQ(taken({at_0, far}), 1) << "no margin says how near it is";
  EXPECT_EQ(taken({at_0}), 0);
  EXPECT_EQ(taken({near, beyond_0}), 7);
  EXPECT_EQ(taken({}), std::nullopt);
}

TEST(Finding, OfCountsNamesTheCount) {
  const Finding finding = within_limits(
      std::array<CountLimit, 3>{{{"frames lost", 10, 1}, {"late", 4, 3}, {"bad CRC", std::nullopt, 99}}});
  EXPECT_EQ(finding.expected.criterion.quantity, "late");
  EXPECT_EQ(finding.measurement.value, 3);
  EXPECT_EQ(to_text(finding.expected.criterion), "<= 4");
}

TEST(Finding, OfTheBusLoadSaysInWhichSecond) {
  Observations seen;
  for (const std::uint32_t bits : {100'000U, 300'000U, 200'000U, 1000U})
    seen.length_by_second.push_back({bits});
  const Finding finding = found(BusLoad{.bitrate = 1'000'000, .below = 0.4}, seen);
  EXPECT_EQ(finding.outcome, Outcome::pass);
  EXPECT_DOUBLE_EQ(*finding.measurement.value, 30);
  EXPECT_EQ(finding.measurement.count, 3U) << "the last second is not whole";
  EXPECT_EQ(finding.measurement.worst_at_us, 1'000'000);
  EXPECT_EQ(to_text(finding.expected.criterion), "< 40 %");
}

// 4 s of answers, ten per second, of one estimator.
class NumbersOfTracks : public testing::Test {
 protected:
  static constexpr std::int64_t second_us = 1'000'000;
  static constexpr scenario::Window window{.from_us = second_us, .to_us = 4 * second_us};

  NumbersOfTracks() {
    track_.quantity = &quantities::attitude_heading;
    track_.longest_wait_us = static_cast<double>(second_us);
    track_.answers_end_us = 4 * second_us;
    for (int k = 1; k <= 40; ++k) {
      const double error_mrad = k == 5 ? 9 : k == 21 ? -4 : k == 40 ? 2 : 1;
      track_.points.push_back(
          {.t_us = k * second_us / 10, .value = error_mrad * 1e-3, .sigma = k == 30 ? 0.3e-3 : 0.2e-3});
    }
  }
  template <class Rule>
  [[nodiscard]] Finding judge(const Rule& rule) const {
    static const world::FlightRecord rest{{.start = {}, .motion = world::Rest{}}, 4 * second_us, 10'000};
    const Observations seen;
    return rule.judge({.seen = seen, .truth = {.flight = rest}, .tracks = {{"one", track_}}});
  }
  [[nodiscard]] Finding error(Error::Statistic statistic) const {
    Error rule = error_of("one", quantities::attitude_heading, window, 5e-3, statistic);
    rule.unit = quantities::mrad;
    return judge(rule);
  }
  quantities::Track track_;
};

TEST_F(NumbersOfTracks, TheWorstErrorOfTheWindowInTheUnitOfTheLimit) {
  const Finding largest = error(Error::Statistic::max);
  EXPECT_NEAR(*largest.measurement.value, 4, 1e-12);
  EXPECT_EQ(largest.measurement.count, 31U);
  EXPECT_EQ(largest.measurement.worst_at_us, 2'100'000);
  const Criterion& criterion = largest.expected.criterion;
  EXPECT_EQ(criterion.quantity, "attitude.heading");
  EXPECT_EQ(criterion.estimator, "one");
  EXPECT_EQ(criterion.statistic, "max");
  EXPECT_EQ(to_text(criterion), "< 5 mrad");
  EXPECT_EQ(criterion.stretch->window.from_us, second_us);
}

TEST_F(NumbersOfTracks, OtherStatisticsSayWhenTheLargestErrorCame) {
  const Finding rms = error(Error::Statistic::rms);
  EXPECT_NEAR(*rms.measurement.value, std::sqrt((29 * 1 + 16 + 4) / 31.0), 1e-12);
  EXPECT_EQ(rms.measurement.worst_at_us, 2'100'000);
  const Finding last = error(Error::Statistic::final);
  EXPECT_NEAR(*last.measurement.value, 2, 1e-12);
  EXPECT_EQ(last.measurement.worst_at_us, 4'000'000);
}

TEST_F(NumbersOfTracks, WithoutAnswersThereIsALimitAndNoValue) {
  track_.points = {};
  const Finding finding = error(Error::Statistic::max);
  EXPECT_EQ(finding.outcome, Outcome::fail);
  EXPECT_FALSE(finding.measurement.value);
  EXPECT_EQ(to_text(finding.expected.criterion), "< 5 mrad");
}

TEST_F(NumbersOfTracks, TheSigmaThatIsNearestToItsLimit) {
  const auto sigma = [&](double low_mrad, double high_mrad) {
    return judge(Sigma{.judged = {.estimator = "one", .quantity = &quantities::attitude_heading},
                       .stretch = {.window = window},
                       .low = low_mrad * 1e-3,
                       .high = high_mrad * 1e-3,
                       .unit = quantities::mrad})
        .measurement;
  };
  EXPECT_NEAR(*sigma(0.01, 0.31).value, 0.3, 1e-12);
  EXPECT_EQ(sigma(0.01, 0.31).worst_at_us, 3'000'000);
  EXPECT_NEAR(*sigma(0.19, 0.9).value, 0.2, 1e-12);
}

}  // namespace
}  // namespace canhil::checks
