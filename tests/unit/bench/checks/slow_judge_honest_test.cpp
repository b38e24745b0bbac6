// The check `honest` against the plain judge.
#include "bench/checks/kinds/honest.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

// trusted.over_sigma (docs/quantities.md) is the largest |error|/sigma of the trusted answers in 20 ms of the
// time to go.
Judged honest(const PlainRun& of, const Honest& rule) {
  std::map<std::int64_t, std::vector<Row>> stretches;  // by minus the time to go
  for (const Row& row : of.rows)
    stretches[-static_cast<std::int64_t>(std::floor(row.to_go_s * 1e6 / 20'000))].push_back(row);
  if (stretches.empty()) return fail("los_rate: no answers to judge");
  bool any_trusted = false;
  double worst = 0, worst_to_go_s = 0, first_to_go_s = 0;
  int wrong = 0;
  for (const auto& [place, rows] : stretches) {
    const double to_go_s = 0.02 * static_cast<double>(1 - place);
    bool numbers = true;
    double largest = 0;
    for (const Row& row : rows) {
      if (row.answer.degraded || row.answer.blind) continue;
      any_trusted = true;
      for (const double ratio :
           {row.pitch / row.answer.rate_sigma.pitch, row.yaw / row.answer.rate_sigma.yaw}) {
        numbers = numbers && std::isfinite(ratio);
        largest = std::max(largest, std::abs(ratio));
      }
      numbers =
          numbers && std::isfinite(row.answer.rate_sigma.pitch) && std::isfinite(row.answer.rate_sigma.yaw);
    }
    if (!numbers && wrong++ == 0) first_to_go_s = to_go_s;
    if (largest > worst) {
      worst = largest;
      worst_to_go_s = to_go_s;
    }
  }
  if (wrong > 0)
    return fail(
        fmt::format("{} of {} errors in sigmas are not a number (NaN or infinite), first at {:g} s to go",
                    wrong, stretches.size(), first_to_go_s));
  if (!any_trusted) return not_measured("los_rate: all answers are degraded or blind, so none is trusted");
  return of.unless_missing(passes_if(worst <= rule.over_sigma,
                                     fmt::format("{:.2f} sigma at {:g} s to go, the largest of {} errors",
                                                 worst, worst_to_go_s, stretches.size())),
                           of.whole());
}

TEST_F(SlowJudge, AgreesAboutHonesty) {
  const auto draw = [](Drawn& run) {
    return Honest{.estimators = {&estimators::los_rate}, .named = {}, .over_sigma = run.one_of({5, 10, 100})};
  };
  expect_agreement({Outcome::pass, Outcome::fail, Outcome::not_measured}, draw, honest);
}

}  // namespace
}  // namespace canhil::checks
