// Tests the plots of quantities over a run: the limit of a check is drawn in the plot of the quantity that
// the check judges, and missing values are gaps.
#include "bench/report/series.hpp"
#include "bench/bindings/canhil.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/checks/kinds/convergence.hpp"
#include "bench/quantities/list.hpp"
#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/world/motion/rest.hpp"
#include "tests/unit/bench/checks/judged.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t duration_us = 20'000'000;

scenario::Scenario scenario_of(std::vector<scenario::Check> checks = {}) {
  scenario::Scenario scenario;
  scenario.binding = bindings::canhil();
  scenario.title = "course";
  scenario.duration_us = duration_us;
  scenario.targets.emplace_back().estimator = "transfer_alignment";
  scenario.checks = std::move(checks);
  return scenario;
}

// 20 s; the heading is off by 200 mrad in the first second and by 1 mrad after it.
drive::Run run_of() {
  drive::Run run{.verdict = {},
                 .ending = {},
                 .seen = {},
                 .truth = {{.start = {}, .motion = world::Rest{}}, duration_us, 10'000},
                 .options = {},
                 .wall_s = 2};
  run.clock = drive::ClockKind::lockstep;
  for (std::int64_t t_us = 10'000; t_us <= duration_us; t_us += 10'000) {
    const double heading = t_us <= 1'000'000 ? 0.2 : 0.001;
    run.seen.of<estimators::TransferAnswers>().navigation.push_back(
        {.cause_us = t_us, .angles = {.roll = 0, .pitch = 0, .heading = heading}});
    if (t_us % 100'000 == 0)
      run.seen.of<estimators::TransferAnswers>().filter.push_back(
          {.cause_us = t_us, .nis = 3, .attitude_sigma = world::Vector3::Constant(0.002)});
  }
  return run;
}

const Series* find(const std::vector<Series>& all, std::string_view quantity) {
  const auto found = std::ranges::find(all, quantity, &Series::quantity);
  return found == all.end() ? nullptr : &*found;
}

scenario::Check heading_below_2_mrad() {
  return checks::check_of(checks::error_of("transfer_alignment", quantities::attitude_heading,
                                           {.from_us = 10'000'000, .to_us = duration_us}, 0.002),
                          "heading at the end");
}

TEST(Series, CarryTheBarsOfTheChecksThatJudgeThem) {
  const drive::Run run = run_of();
  EXPECT_EQ(find(series(scenario_of(), run), "heading error"), nullptr) << "nobody judges it";
  const scenario::Check convergence = checks::check_of(
      checks::Convergence{
          .judged = {.estimator = "transfer_alignment", .quantity = &quantities::attitude_heading},
          .within = 0.003,
          .before_us = 5'000'000,
          .end_us = duration_us},
      "converges");
  const auto all = series(scenario_of({heading_below_2_mrad(), convergence}), run);
  const Series* heading = find(all, "heading error");
  ASSERT_NE(heading, nullptr);
  ASSERT_EQ(heading->bars.size(), 2U);
  EXPECT_EQ(heading->bars[0].check, "heading at the end");
  EXPECT_NEAR(heading->bars[0].below, 2, 1e-9) << "in mrad, as the series";
  EXPECT_EQ(heading->bars[0].from_s, 10);
  EXPECT_EQ(heading->bars[0].to_s, 20);
  EXPECT_EQ(heading->bars[1].from_s, 5) << "from when it must have converged";
  EXPECT_NEAR(heading->points.back().high, 1, 1e-3);
  EXPECT_TRUE(find(all, "velocity error north")->bars.empty());
}

TEST(Series, ABarThatTheFirstInstantsHideIsDrawnInASecondPicture) {
  const Json report = document(scenario_of({heading_below_2_mrad()}), run_of());
  const auto& all = report.at("series");
  const auto heading =
      std::ranges::find_if(all, [](const Json& s) { return s["quantity"] == "heading error"; });
  ASSERT_NE(heading, all.end());
  EXPECT_EQ((*heading)["bars"][0]["check"], "heading at the end");
  const std::string page = html(report).value();
  EXPECT_THAT(page, HasSubstr("limit of 'heading at the end': 2 mrad from 10 to 20\u00a0s"));
  EXPECT_THAT(page, ContainsRegex("<h3>heading error, from 1.[0-9]* s on</h3>"));
  EXPECT_THAT(page, HasSubstr("stroke-width=\"2.6\""));
  EXPECT_THAT(page, Not(HasSubstr("velocity error north, from")))
      << "its late course is as large as the first";
}

TEST(Series, ShowTheEstimateBesideTheTruthWithoutAJumpAtSouth) {
  drive::Run run = run_of();
  const double south = std::numbers::pi;
  run.truth = {{.start = {}, .motion = world::Rest{.angles = {.roll = 0, .pitch = 0, .heading = south}}},
               duration_us,
               10'000};
  for (auto& answer : test::Edited(run.seen.of<estimators::TransferAnswers>().navigation)) {
    const double off = answer.cause_us % 20'000 == 0 ? 0.001 : -0.001;
    answer.angles.heading = std::remainder(south + off, 2 * std::numbers::pi);
  }
  const auto all = series(scenario_of(), run);
  const Series* heading = find(all, "heading");
  ASSERT_NE(heading, nullptr);
  EXPECT_EQ(heading->kind, Series::Kind::estimate);
  for (const Series::Point& point : heading->points) {
    EXPECT_NEAR(point.high, point.truth.value(), 0.1);
    EXPECT_NEAR(point.low, point.truth.value(), 0.1);
  }
  EXPECT_THAT(html(document(scenario_of(), run)).value(), HasSubstr("</svg> truth</span>"));
}

TEST(Series, ASigmaThatIsStaleIsAGap) {
  drive::Run run = run_of();
  std::erase_if(*test::Edited(run.seen.of<estimators::TransferAnswers>().filter),
                [](const auto& a) { return a.cause_us > 5'000'000 && a.cause_us < 15'000'000; });
  const auto all = series(scenario_of(), run);
  for (const Series::Point& point : find(all, "attitude error about down")->points) {
    const bool reported = (point.t_s > 0.2 && point.t_s < 5.9) || point.t_s > 15.1;
    const bool stale = point.t_s > 6.1 && point.t_s < 14.9;
    EXPECT_TRUE(!reported || point.sigma) << point.t_s;
    EXPECT_TRUE(!stale || !point.sigma) << point.t_s << ": reported at 5 s";
  }
}

// A fix arrives each second, except for 10 s without fixes. The last value before this gap becomes stale
// after 3 s.
TEST(Series, ASigmaOfFixesIsStaleAfterThreeOfThem) {
  drive::Run run = run_of();
  scenario::Scenario scenario = scenario_of();
  scenario.targets[0].estimator = "inflight_alignment";
  run.seen.of<estimators::InflightAnswers>().navigation =
      run.seen.of<estimators::TransferAnswers>().navigation;
  for (std::int64_t t_us = 1'000'000; t_us <= duration_us; t_us += 1'000'000) {
    if (t_us > 5'000'000 && t_us < 15'000'000) continue;
    run.seen.of<estimators::InflightAnswers>().sent.push_back({.valid_us = t_us});
    run.seen.of<estimators::InflightAnswers>().fixes.push_back(
        {.cause_us = t_us, .attitude_sigma = {0, 0, 0.01}});
  }
  const auto all = series(scenario, run);
  for (const Series::Point& point : find(all, "attitude error about down")->points) {
    EXPECT_TRUE(point.t_s < 1.1 || point.t_s > 7.9 || point.sigma) << point.t_s;
    EXPECT_TRUE(point.t_s < 8.1 || point.t_s > 14.9 || !point.sigma) << point.t_s;
  }
}

TEST(Series, SilenceIsAGapUpToTheEndOfTheRun) {
  drive::Run run = run_of();
  std::erase_if(*test::Edited(run.seen.of<estimators::TransferAnswers>().navigation),
                [](const auto& a) { return a.cause_us > 5'000'000 && a.cause_us < 8'000'000; });
  std::erase_if(*test::Edited(run.seen.of<estimators::TransferAnswers>().navigation),
                [](const auto& a) { return a.cause_us > 12'000'000; });
  const auto all = series(scenario_of(), run);
  const auto& points = find(all, "attitude error about down")->points;
  const auto silent = [&](double t_s) {
    const auto after = std::ranges::upper_bound(points, t_s, {}, &Series::Point::t_s);
    return std::isnan(std::prev(after)->low);
  };
  EXPECT_FALSE(silent(4.9));
  EXPECT_TRUE(silent(6));
  EXPECT_FALSE(silent(8.1));
  EXPECT_TRUE(silent(12.1));
  EXPECT_EQ(points.back().t_s, 20) << "the picture shows the whole run";
}

}  // namespace
}  // namespace canhil::report
