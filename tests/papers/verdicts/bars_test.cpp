// Tests that each acceptance limit ('bar') of a paper has an effect: if a figure is just beyond the limit,
// the claim fails, and so does the whole page.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/papers/verdicts/made_up.hpp"

namespace canhil::papers {
namespace {

// One limit of a figure. `value` is the upper limit if `at_most` is true, and the lower limit if `at_most` is
// false. `figure` is the name of the figure. If `figure` is empty, the limit applies to the value of the
// quantity itself.
struct Bar {
  std::string figure;
  double value = 0;  // in the unit of the report
  bool at_most = true;
};

std::string in_unit(const char* stem, const quantities::Quantity& quantity) {
  return fmt::format("{}{}", stem, quantity.unit.ending);
}

class BarsOf {
 public:
  std::vector<Bar> operator()(const campaign::ToGo& rule) {
    const quantities::Unit& unit = rule.quantity->unit;
    at_most(in_unit("rms", *rule.quantity), rule.rms_at_most, unit.factor);
    if (rule.mean_between) {
      at_least(in_unit("mean", *rule.quantity), rule.mean_between->first, unit.factor);
      at_most(in_unit("mean", *rule.quantity), rule.mean_between->second, unit.factor);
    }
    at_most("ratio", rule.ratio_at_most);
    at_least("ratio", rule.ratio_at_least);
    return bars_;
  }
  std::vector<Bar> operator()(const campaign::RunMean& rule) {
    const double factor = rule.quantity->unit.factor;
    at_most(in_unit("mean", *rule.quantity), rule.at_most, factor);
    at_least(in_unit("mean", *rule.quantity), rule.at_least, factor);
    at_most("ratio", rule.ratio_at_most);
    at_least("ratio", rule.ratio_at_least);
    return bars_;
  }
  std::vector<Bar> operator()(const campaign::RmsRatio& rule) {
    at_most("ratio", rule.at_most);
    return bars_;
  }
  std::vector<Bar> operator()(const campaign::Diverged& rule) {
    if (rule.at_most) at_most("", rule.beyond, rule.quantity->unit.factor);
    return bars_;
  }
  // Metrics of other kinds have no limits in these papers.
  template <class Rule>
  std::vector<Bar> operator()(const Rule&) {
    return {};
  }

 private:
  void at_most(const std::string& figure, const std::optional<double>& bar, double factor = 1) {
    if (bar) bars_.push_back({.figure = figure, .value = *bar / factor, .at_most = true});
  }
  void at_least(const std::string& figure, const std::optional<double>& bar, double factor = 1) {
    if (bar) bars_.push_back({.figure = figure, .value = *bar / factor, .at_most = false});
  }
  std::vector<Bar> bars_;
};

// The value of the quantity in a run in which all stored quantities are 1. A quantity that is derived from
// stored quantities may differ from 1.
double itself(const campaign::Variant& variant, const campaign::Answer& answer) {
  return run_at(variant, 0, 1).samples.value(0, *answer.quantity) / answer.quantity->unit.factor;
}

// The claims of the papers on LOS rate and wind depend on figures that are proportional to the errors of a
// variant. The test sets the errors so that a figure is just within its limit: claim and page must pass. Then
// it sets them so that the figure is just beyond the limit: claim and page must fail.
class FiguresBeyondABar : public testing::TestWithParam<int> {};

TEST_P(FiguresBeyondABar, FailItsAnswerAndThePage) {
  const Paper& paper = papers.at(static_cast<std::size_t>(GetParam()));
  MadeUp made_up(paper);
  ASSERT_TRUE(made_up.bars_met());
  int bars = 0;
  for (const Flown& flown : made_up.results.campaigns) {
    for (const campaign::Metric& metric : flown.campaign.metrics) {
      campaign::Campaign alone = flown.campaign;
      alone.metrics = {metric};
      const auto at_ones = answers_at(alone, {});
      const auto of_variant = [](const std::vector<campaign::Answer>& answers, const std::string& variant) {
        return *std::ranges::find(answers, variant, &campaign::Answer::variant);
      };
      for (const std::size_t place : campaign::variants_of(alone, metric)) {
        const std::string& variant = alone.variants[place].name;
        campaign::Answer& kept = made_up.answer(flown.name, metric.name, variant);
        const std::vector<Bar> of_metric = std::visit(BarsOf(), metric.rule);
        EXPECT_EQ(kept.passed.has_value(), !of_metric.empty()) << flown.name << ": " << metric.name;
        for (const Bar& bar : of_metric) {
          const campaign::Answer at_one = of_variant(at_ones, variant);
          const double in_proportion = bar.value / (bar.figure.empty() ? itself(alone.variants[place], at_one)
                                                                       : figure(at_one, bar.figure));
          for (const bool within : {true, false}) {
            const double off = within == bar.at_most ? 0.999 : 1.001;
            const auto found = of_variant(answers_at(alone, {{variant, off * in_proportion}}), variant);
            const auto what = fmt::format("{}: {} ({}): {}, expected {}", flown.name, metric.name, variant,
                                          found.measured, found.expected);
            EXPECT_EQ(found.passed, within) << what;
            const std::optional<bool> before = std::exchange(kept.passed, found.passed);
            EXPECT_EQ(made_up.bars_met(), within) << what;
            kept.passed = before;
          }
          ++bars;
        }
      }
    }
  }
  EXPECT_GT(bars, 10);
}

std::string name_of(const testing::TestParamInfo<int>& info) {
  return papers.at(static_cast<std::size_t>(info.param)).name;
}
INSTANTIATE_TEST_SUITE_P(Papers, FiguresBeyondABar, testing::Values(2, 3), name_of);

// For all four papers: if any claim with a limit fails, the page must fail.
class AMissedBar : public testing::TestWithParam<int> {};

TEST_P(AMissedBar, FailsThePage) {
  MadeUp made_up(papers.at(static_cast<std::size_t>(GetParam())));
  ASSERT_TRUE(made_up.bars_met());
  int bars = 0;
  for (Flown& flown : made_up.results.campaigns) {
    for (campaign::Answer& answer : flown.evaluation.answers) {
      if (!answer.passed) continue;
      for (const std::optional<bool> spoilt : {std::optional(false), std::optional<bool>()}) {
        answer.passed = spoilt;
        EXPECT_FALSE(made_up.bars_met())
            << flown.name << ": " << answer.metric << " (" << answer.variant << ")";
      }
      answer.passed = true;
      ++bars;
    }
  }
  EXPECT_GT(bars, 10);
  EXPECT_TRUE(made_up.bars_met());
}
INSTANTIATE_TEST_SUITE_P(Papers, AMissedBar, testing::Range(0, 4), name_of);

}  // namespace
}  // namespace canhil::papers
