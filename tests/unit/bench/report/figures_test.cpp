// Comparing the numbers of a check.
#include "bench/report/figures.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/report/compare.hpp"

namespace canhil::report {
namespace {

using checks::Judgement;
using testing::HasSubstr;
using Change = FiguresCompared::Change;

Judgement rms_of(double value) {
  return {.criterion = {.upper = checks::exclusive(2.3), .unit = "mrad/s"}, .measurement = {.value = value}};
}

std::vector<Judgement> runs_of(const std::vector<double>& values) {
  std::vector<Judgement> runs;
  for (const double value : values) runs.push_back(rms_of(value));
  return runs;
}

constexpr FigureRule in_virtual_time{.tolerance = 0.1, .largest_p = 0.01, .repeatable = true};
constexpr FigureRule in_real_time{.tolerance = 0.1, .largest_p = 0.01, .repeatable = false};

FiguresCompared figures_of(const std::vector<double>& before, const std::vector<double>& after,
                           const FigureRule& rule = in_virtual_time) {
  return compare_figures(runs_of(before), runs_of(after), rule).value();
}

TEST(CompareFigures, ADriftWithinTheLimitIsWorseWithBothNumbers) {
  const FiguresCompared drift = figures_of({0.943}, {1.370});
  EXPECT_EQ(drift.change, Change::worse);
  EXPECT_EQ(drift.text, "0.943 -> 1.37 mrad/s, limit < 2.3 mrad/s, margin 59.0 % -> 40.4 %");
  EXPECT_EQ(figures_of({1.370}, {0.943}).change, Change::changed) << "better";
}

TEST(CompareFigures, TheToleranceIsAShareOfTheLimit) {
  FigureRule rule = in_virtual_time;
  rule.tolerance = 0.19;
  EXPECT_EQ(figures_of({0.943}, {1.370}, rule).change, Change::changed);
  rule.tolerance = 0.18;
  EXPECT_EQ(figures_of({0.943}, {1.370}, rule).change, Change::worse);
  rule.tolerance = 0;
  EXPECT_EQ(figures_of({0.943}, {0.944}, rule).change, Change::worse);
}

TEST(CompareFigures, AnyChangeInVirtualTimeIsShown) {
  EXPECT_EQ(figures_of({0.943}, {0.943}).change, Change::same);
  const FiguresCompared small = figures_of({0.9430001}, {0.9430002});
  EXPECT_EQ(small.change, Change::changed);
  EXPECT_THAT(small.text, HasSubstr("0.9430001 -> 0.9430002 mrad/s"));
  EXPECT_EQ(figures_of({0.943}, {0.943 * (1 + 1e-14)}).change, Change::same) << "rounding of another CPU";
}

TEST(CompareFigures, OneRunASideInRealTimeIsNeverWorse) {
  EXPECT_EQ(figures_of({0.1}, {2.2}, in_real_time).change, Change::changed);
}

TEST(CompareFigures, SeveralRunsASideAreComparedWithTheirScatter) {
  EXPECT_EQ(figures_of({0.94, 0.95, 0.93, 0.94}, {1.37, 1.36, 1.38, 1.37}, in_real_time).change,
            Change::worse);
  EXPECT_EQ(figures_of({1.37, 1.36, 1.38, 1.37}, {0.94, 0.95, 0.93, 0.94}, in_real_time).change,
            Change::changed);
  EXPECT_EQ(figures_of({0.3, 1.9, 0.5, 1.2}, {1.0, 2.2, 0.9, 1.4}, in_real_time).change, Change::same);
  EXPECT_EQ(figures_of({0.94, 0.95, 0.93, 0.94}, {0.99, 0.98, 1.00, 0.99}, in_real_time).change,
            Change::changed)
      << "significant, but within the tolerance";
  EXPECT_EQ(figures_of({0.94, 0.94}, {1.37, 1.37}, in_real_time).change, Change::worse)
      << "no scatter at all";
  EXPECT_THAT(figures_of({0.94, 0.95}, {1.37, 1.36}, in_real_time).text,
              HasSubstr("0.94..0.95 -> 1.36..1.37 mrad/s, limit < 2.3 mrad/s, margin 58.7..59.1 % -> "));
}

TEST(CompareFigures, EqualRunsThatScatterAreAsRarelyWorseAsPSays) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> latency(-1, 0.8);
  const auto four = [&] {
    std::vector<double> values(4);
    std::ranges::generate(values, [&] { return latency(random); });
    return values;
  };
  int worse = 0;
  for (int i = 0; i < 1000; ++i) worse += figures_of(four(), four(), in_real_time).change == Change::worse;
  EXPECT_LE(worse, 20);  // binomial of 1000 and 0.01: 10 +- 3.1
}

TEST(CompareFigures, WithoutAMarginAChangeIsShown) {
  Judgement none{.criterion = {.upper = checks::Limit{0}}, .measurement = {.value = 0}};
  Judgement three = none;
  three.measurement.value = 3;
  EXPECT_EQ(compare_figures({none}, {three}, in_virtual_time)->change, Change::changed);
  EXPECT_EQ(compare_figures({none}, {three}, in_virtual_time)->text, "0 -> 3, limit <= 0");
  EXPECT_FALSE(compare_figures({}, {three}, in_virtual_time));
}

// A report of a run in virtual time with one check.
nlohmann::ordered_json report_with(double value) {
  return {{"verdict", "pass"},
          {"reason", "1 check passed"},
          {"provenance",
           {{"scenario_hash", "1"}, {"contract", "classic"}, {"clock", "lockstep"}, {"seed", 5}, {"run", 0}}},
          {"checks",
           {{{"name", "rms"},
             {"kind", "error"},
             {"outcome", "pass"},
             {"measured", "RMS"},
             {"value", value},
             {"upper", 2.3},
             {"upper_inclusive", false},
             {"unit", "mrad/s"}}}},
          {"timing", {{"judged", false}, {"why_not", "virtual time"}}}};
}

TEST(CompareFigures, AreComparedForEachCheckOfTheReports) {
  const auto result = compare({report_with(0.943)}, {report_with(1.370)});
  EXPECT_EQ(result->outcome, Comparison::worse);
  EXPECT_THAT(result->text, HasSubstr("worse    check 'rms': pass; 0.943 -> 1.37 mrad/s, limit < 2.3 mrad/s, "
                                      "margin 59.0 % -> 40.4 %\n"));
  EXPECT_EQ(compare({report_with(0.943)}, {report_with(1.370)}, 0.2)->outcome, Comparison::no_worse);
  EXPECT_THAT(compare({report_with(0.943)}, {report_with(0.943)})->text, HasSubstr("same     check 'rms'"));
}

// With another seed the noise differs, so the numbers scatter as in real time.
TEST(CompareFigures, AnotherSeedIsNoEqualRun) {
  auto other = report_with(1.370);
  other["provenance"]["seed"] = 6;
  EXPECT_EQ(compare({report_with(0.943)}, {other})->outcome, Comparison::no_worse);
  EXPECT_THAT(compare({report_with(0.943)}, {other})->text,
              HasSubstr("one run a side: no margin counts as worse, because runs differ"));
}

TEST(CompareFigures, OfAFailureThatWasThereBeforeCanGetWorse) {
  auto bad = report_with(2.5), worse = report_with(4);
  for (auto* one : {&bad, &worse}) (*one)["checks"][0]["outcome"] = "fail";
  EXPECT_EQ(compare({bad}, {worse})->outcome, Comparison::worse);
  EXPECT_EQ(compare({bad}, {bad})->outcome, Comparison::no_worse);
}

}  // namespace
}  // namespace canhil::report
