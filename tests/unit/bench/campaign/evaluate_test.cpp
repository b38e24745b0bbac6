// Limits of metrics, and the effect of a missing run.
#include "bench/campaign/evaluate.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/campaign_report/report.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

using testing::HasSubstr;

// From 0.2 s on, the RMS of variant A is within 3 mrad; the RMS of variant B never is. In three of four runs,
// A is better than B.
std::vector<RunSeries> runs_of(std::size_t variant) {
  std::vector<RunSeries> runs;
  for (std::uint64_t run = 0; run < 4; ++run) {
    runs.push_back(variant == 0 ? run_with(run, held({9e-3, 2e-3, 1e-3}))
                                : run_with(run, held({9e-3, 8e-3, run == 3 ? 0 : 8e-3})));
  }
  return runs;
}

Result<Evaluation> ask(const std::string& metric, const Load& load = runs_of) {
  return parse(two_variants + "[[metric]]\nquantity = 'attitude.heading'\n" + metric)
      .and_then([&](const Campaign& campaign) { return evaluate(campaign, load); });
}

std::optional<bool> passed(const std::string& metric, std::size_t answer = 0) {
  const auto evaluation = ask(metric);
  EXPECT_TRUE(evaluation) << evaluation.error().message;
  return evaluation->answers.at(answer).passed;
}

TEST(Bars, OfTimeWithin) {
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\n"), std::nullopt);
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nat_most_s = 0.2\n"), true);
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nat_most_s = 0.19\n"), false);
  // B never comes within 3 mrad.
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nat_most_s = 9.0\n", 1), false);
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nnever_before_s = 0.3\n"), false);
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nnever_before_s = 0.2\n"), true);
  EXPECT_EQ(passed("kind = 'time_within'\nwithin_mrad = 3\nnever_before_s = 9.0\n", 1), true);
}

TEST(Bars, OfLead) {
  EXPECT_EQ(passed("kind = 'lead'\nwithin_mrad = 8.5\nother = 'B'\nat_least_s = 0.0\n"), true);
  EXPECT_EQ(passed("kind = 'lead'\nwithin_mrad = 8.5\nother = 'B'\nat_least_s = 0.1\n"), false);
  // B never comes within 3 mrad. The last line compares A with itself.
  EXPECT_EQ(passed("kind = 'lead'\nwithin_mrad = 3\nother = 'B'\nat_least_s = 5.0\n"), true);
  EXPECT_EQ(passed("kind = 'lead'\nwithin_mrad = 3\nother = 'A'\nat_least_s = 0.0\n"), false);
}

TEST(Bars, OfValuesWindowsPairsAndDivergence) {
  EXPECT_EQ(passed("kind = 'value_at'\nat_s = 0.2\nat_most_mrad = 2.001\n"), true);
  EXPECT_EQ(passed("kind = 'value_at'\nat_s = 0.2\nat_most_mrad = 1.999\n"), false);
  EXPECT_EQ(passed("kind = 'value_at'\nat_s = 0.2\nat_least_mrad = 2.001\n"), false);
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nmean_at_most_mrad = 1.501\n"), true);
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nmean_at_most_mrad = 1.499\n"), false);
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nstandard_deviation_at_most_mrad = 0.5\n"),
            false);  // the standard deviation is 0.53 mrad
  EXPECT_EQ(passed("kind = 'paired'\nat_s = 3.0\nother = 'B'\nat_least = 0.75\n"), true);
  EXPECT_EQ(passed("kind = 'paired'\nat_s = 3.0\nother = 'B'\nat_least = 0.76\n"), false);
  EXPECT_EQ(passed("kind = 'divergence'\nbeyond_mrad = 5\nat_most = 0\n"), true);
  EXPECT_EQ(passed("kind = 'divergence'\nbeyond_mrad = 5\nat_most = 2\n", 1), false);
  EXPECT_EQ(passed("kind = 'divergence'\nbeyond_mrad = 5\nat_least = 3\n", 1), true);
}

TEST(Bars, OfConsistencyAndWarnings) {
  // NIS is 0 in all four runs; 99.9 % of the means of four chi-square values lie between 0.5 and 8.
  const auto campaign =
      parse(two_variants +
            "[[metric]]\nkind = 'consistency'\nquantity = 'innovation.nis'\nmean_probability = 0.999\n");
  ASSERT_TRUE(campaign) << campaign.error().message;
  EXPECT_EQ(evaluate(*campaign, runs_of)->answers.at(0).passed, false);
  // The heading of A is beyond 1 mrad for some updates, that of B for all.
  const std::string warning = "kind = 'divergence'\nfrom_s = 0\nbeyond_mrad = 1\n";
  EXPECT_EQ(passed(warning + "within_s = 9\nat_most = 0\n", 1), true);
  EXPECT_EQ(passed(warning + "within_s = 1\nat_most = 0\n", 1), false);
  EXPECT_EQ(passed(warning + "within_s = 1\nat_most = 3\n", 1), true);
}

std::string limits_of(const std::string& metrics, std::size_t answer) {
  const auto campaign = parse(two_variants + metrics);
  if (!campaign) return campaign.error().message;
  return evaluate(*campaign, runs_of)->answers.at(answer).expected;
}

// The quantiles are those of tables: chi2(12) at 0.05 % and 99.95 % is 1.9344 and 34.821; t(3) at 99.95 %
// is 12.924.
TEST(Bars, OfSamplingDistributionsScaleWithTheRuns) {
  const std::string nis = "[[metric]]\nkind = 'consistency'\nquantity = 'innovation.nis'\nvariants = ['A']\n";
  EXPECT_EQ(limits_of(nis + "mean_probability = 0.999\n", 0), "mean from 0.483594 to 8.70532");
  EXPECT_EQ(limits_of(nis + "mean_probability = 0.999\nexpected_at_least = 1.5\n", 0),
            "mean from 0.241797 to 8.70532");
  const std::string heading =
      "[[metric]]\nvariants = ['B']\nunit = 'deg'\nkind = 'distribution'\nquantity = "
      "'attitude.heading'\nat_s = 0.3\n";
  EXPECT_EQ(limits_of(heading + "rms_probability = 0.9\nexpected_deg = 2\nexpected_at_least_deg = 1\n", 0),
            "RMS at least 0.4215 deg, RMS at most 3.08 deg");  // chi2(4) at 5 and 95 %: 0.7107, 9.4877
  const std::string mean = "[[metric]]\nvariants = ['B']\nkind = 'run_mean'\nquantity = 'attitude.heading'\n";
  // The four means are 8.033 (three times) and 0.567 mrad, so their standard deviation is 3.733.
  EXPECT_EQ(limits_of(mean + "from_s = 0.1\nmean_probability = 0.999\nexpected_mrad = 6\n", 0),
            "at least -18.12 mrad, at most 30.12 mrad");
}

TEST(Bars, OfSamplingDistributionsShareTheirProbability) {
  const std::string nis = "[[metric]]\nkind = 'consistency'\nquantity = 'innovation.nis'\n";
  const std::string alone = limits_of(nis + "variants = ['A']\nmean_probability = 0.9995\n", 0);
  EXPECT_EQ(limits_of(nis + "mean_probability = 0.999\n", 1), alone) << "two variants";
  EXPECT_EQ(limits_of(nis + "name = 'a'\nvariants = ['A']\nmean_probability = 0.999\n" + nis +
                          "name = 'b'\nvariants = ['B']\nmean_probability = 0.999\n" + nis,
                      1),
            alone)
      << "two metrics, and one without this limit";
}

TEST(Bars, OfSamplingDistributionsNeedAnExpectation) {
  const std::string heading =
      "[[metric]]\nkind = 'distribution'\nquantity = 'attitude.heading'\nat_s = 0.3\n";
  EXPECT_THAT(limits_of(heading + "rms_probability = 0.9\n", 0), HasSubstr("expected"));
  EXPECT_THAT(limits_of(heading + "expected_mrad = 2\n", 0), HasSubstr("rms_probability"));
  EXPECT_THAT(limits_of(heading + "rms_probability = 1\nexpected_mrad = 2\n", 0), HasSubstr("0.999999"));
}

TEST(Bars, OfSharesOfTheRunsAreRoundedDown) {
  const std::string beyond =
      "[[metric]]\nquantity = 'attitude.heading'\nkind = 'divergence'\nfrom_s = 0\nbeyond_mrad = "
      "1\n";  // all
              // runs
              // of
              // B
  EXPECT_EQ(limits_of(beyond + "at_most_share = 0.49\n", 1), "at most 1");
  EXPECT_EQ(limits_of(beyond + "at_most_share = 0.5\n", 1), "at most 2");
  EXPECT_EQ(limits_of(beyond + "at_most_share = 0.01\n", 1), "at most 0");
  EXPECT_THAT(limits_of(beyond + "at_most_share = 0.01\nat_most = 1\n", 1), HasSubstr("one of the two"));
}

TEST(Bars, OfTheRmsOverAWindow) {
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nrms_at_most_mrad = 1.5811\n"), false);
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nrms_at_most_mrad = 1.5812\n"), true);
  EXPECT_EQ(passed("kind = 'window'\nfrom_s = 0.2\nto_s = 0.3\nrms_at_least_mrad = 1.5812\n"), false);
}

TEST(Bars, OfDistributions) {
  const auto of_b = [](const std::string& bar) {  // the four runs of B have 8, 8, 8 and 0 mrad
    return passed("kind = 'distribution'\nat_s = 0.3\n" + bar, 1);
  };
  EXPECT_EQ(of_b(""), std::nullopt);
  EXPECT_EQ(of_b("median_at_most_mrad = 8"), true);
  EXPECT_EQ(of_b("median_at_most_mrad = 7.9"), false);
  EXPECT_EQ(of_b("median_at_least_mrad = 8.1"), false);
  EXPECT_EQ(of_b("p90_at_most_mrad = 7.9"), false);
  EXPECT_EQ(of_b("rms_at_most_mrad = 6.93"), true);  // sqrt(48)
  EXPECT_EQ(of_b("rms_at_most_mrad = 6.92"), false);
  EXPECT_EQ(of_b("rms_at_least_mrad = 6.93"), false);
  EXPECT_EQ(of_b("below_mrad = 1\nfraction_at_least = 0.25"), true);
  EXPECT_EQ(of_b("below_mrad = 1\nfraction_at_least = 0.26"), false);
  EXPECT_EQ(of_b("below_mrad = 1\nfraction_at_most = 0.24"), false);
  EXPECT_EQ(of_b("unit = 'deg'\nmedian_at_most_deg = 0.459"), true);  // 8 mrad are 0.4584 deg
  EXPECT_EQ(of_b("unit = 'deg'\nmedian_at_most_deg = 0.458"), false);
}

TEST(Distribution, SaysWhatItFoundInItsUnit) {
  const auto evaluation = ask("kind = 'distribution'\nunit = 'deg'\nat_s = 0.3\nbelow_deg = 0.1\n");
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  const Answer& answer = evaluation->answers.at(0);
  EXPECT_EQ(
      answer.measured,
      "RMS 0.0573 deg (of 4 runs: 0.0573 to 0.0573), median 0.0573 deg, p90 0.0573 deg, below 0.1 deg in "
      "100.0 %");
  const auto figure = std::ranges::find(answer.figures, "median_deg", [](const auto& f) { return f.first; });
  ASSERT_NE(figure, answer.figures.end());
  EXPECT_NEAR(*figure->second, 0.0572958, 1e-6);
}

TEST(Distribution, AFractionNeedsABound) {
  const auto evaluation = ask("kind = 'distribution'\nat_s = 0.3\nfraction_at_least = 0.5\n");
  ASSERT_FALSE(evaluation);
  EXPECT_THAT(
      evaluation.error().message,
      HasSubstr("key 'metric[1].fraction_at_least': has no effect without a bound, expected below_mrad "
                "beside it"));
}

TEST(Bars, AreNotMetWhileARunIsMissing) {
  const auto one_faulted = [](std::size_t variant) -> Result<std::vector<RunSeries>> {
    auto runs = runs_of(variant);
    runs[1] = run_with(1, variant == 0 ? std::vector{9e-3, 2e-3} : std::vector{9e-3, 8e-3});
    runs[1].ending = {.kind = drive::Ending::Kind::target_fault, .t_us = 250'000, .detail = "input_silent"};
    return runs;
  };
  for (const std::string metric : {"kind = 'time_within'\nwithin_mrad = 3\nnever_before_s = 0.0\n",
                                   "kind = 'value_at'\nat_s = 3.0\nat_most_mrad = 100\n",
                                   "kind = 'distribution'\nat_s = 3.0\nrms_at_most_mrad = 100\n",
                                   "kind = 'window'\nmean_at_most_mrad = 100\n"}) {
    const auto evaluation = ask(metric, one_faulted);
    ASSERT_TRUE(evaluation) << evaluation.error().message;
    EXPECT_EQ(evaluation->answers[0].passed, false) << metric;
    EXPECT_EQ(evaluation->outcome(), checks::Outcome::fail);
    EXPECT_EQ(evaluation->endings[0].completed, 3U);
    EXPECT_EQ(evaluation->endings[0].first_fault, "run 1: input_silent");
  }
}

TEST(Evaluate, RefusesResultsWithRunsMissing) {
  const auto evaluation =
      ask("kind = 'rms_curve'\n", [](std::size_t variant) -> Result<std::vector<RunSeries>> {
        auto runs = runs_of(variant);
        if (variant == 1) runs.pop_back();
        return runs;
      });
  ASSERT_FALSE(evaluation);
  EXPECT_THAT(evaluation.error().message, HasSubstr("variant 'B' has 3 of 4 runs"));
}

TEST(Report, OfACampaignThatAsksForNothingIsNotMeasured) {
  const auto campaign = parse(two_variants);
  const auto evaluation = evaluate(*campaign, runs_of);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  EXPECT_EQ(evaluation->outcome(), checks::Outcome::not_measured);
  EXPECT_EQ(nlohmann::json::parse(json({.campaign = *campaign, .evaluation = *evaluation}))["outcome"],
            "not measured");
  EXPECT_THAT(text({.campaign = *campaign, .evaluation = *evaluation}), HasSubstr("seed 3 · not measured"));
}

TEST(Report, NamesThatAreNotUtf8MakeJsonAllTheSame) {
  auto campaign = parse(two_variants);
  auto evaluation = evaluate(*campaign, runs_of);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  campaign->sources.file = "q\xFF.toml";
  evaluation->endings[0].first_fault = "run 1: \xFF";
  const auto root = nlohmann::json::parse(json({.campaign = *campaign, .evaluation = *evaluation}));
  EXPECT_EQ(root["campaign"], "q\uFFFD.toml");
}

TEST(Report, OfMetricsWithoutABarIsNotMeasured) {
  const auto evaluation =
      ask("kind = 'rms_curve'\n[[metric]]\nquantity = 'attitude.roll'\nkind = 'value_at'\nat_s = 1.0\n");
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  EXPECT_EQ(evaluation->outcome(), checks::Outcome::not_measured);
  EXPECT_EQ(evaluation->not_judged(), "nothing was judged: no [[metric]] has a limit");
}

// Variant B looks worse than variant A in every run, because B has no values at all.
TEST(Report, OfAVariantThatNeverFlewIsNoPass) {
  const auto unflown = [](std::size_t variant) {
    auto runs = runs_of(variant);
    for (RunSeries& run : runs) {
      if (variant == 0) continue;
      run.samples = Samples(estimators::transfer_alignment.layout);
      run.ending = {.kind = drive::Ending::Kind::target_fault, .t_us = 0, .detail = "input_silent"};
    }
    return runs;
  };
  const std::string better = "kind = 'paired'\nat_s = 3.0\nother = 'B'\nvariants = ['A']\nat_least = 0.9\n";
  const auto paired = ask(better, unflown);
  ASSERT_TRUE(paired) << paired.error().message;
  EXPECT_EQ(paired->answers.at(0).passed, true);
  EXPECT_EQ(paired->outcome(), checks::Outcome::not_measured);
  EXPECT_EQ(paired->not_judged(),
            "variant 'B' was not judged: none of its runs was completed (run 0: input_silent), and it has no "
            "limit");
  const std::string astray =
      "[[metric]]\nkind = 'divergence'\nquantity = 'attitude.heading'\nbeyond_mrad = 1\n";
  EXPECT_EQ(ask(better + astray + "variants = ['B']\nat_least = 4\n", unflown)->outcome(),
            checks::Outcome::pass)
      << "as it was meant to";
  EXPECT_EQ(ask(better + astray + "at_most = 0\n", unflown)->outcome(), checks::Outcome::fail);
}

TEST(Report, CurvesAreInJson) {
  const auto campaign =
      parse(two_variants + "[[metric]]\nkind = 'rms_curve'\nquantity = 'attitude.heading'\n");
  const auto evaluation = evaluate(*campaign, runs_of);
  const auto json =
      nlohmann::json::parse(canhil::campaign::json({.campaign = *campaign, .evaluation = *evaluation}));
  EXPECT_EQ(json["outcome"], "not measured");
  const auto& curve = json["answers"][0]["curve"];
  EXPECT_EQ(curve["t_s"].size(), 30U);
  EXPECT_EQ(curve["t_s"][1], 0.2);
  EXPECT_DOUBLE_EQ(curve["rms_mrad"][1].get<double>(), 2);
  EXPECT_THAT(text({.campaign = *campaign, .evaluation = *evaluation}),
              HasSubstr("A        4 of 4 runs completed"));
}

}  // namespace
}  // namespace canhil::campaign
