// The check of the delay against the plain judge, which tries all delays and knows the truth at all times.
#include <numbers>

#include "bench/checks/kinds/delay.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

// The LOS rate in yaw [rad/s] and its derivative. Its period is longer than the search for the delay.
constexpr double amplitude = 0.05, omega = 2 * std::numbers::pi / 2.5;
double yaw(double t) { return amplitude * std::sin(omega * t); }
double yaw_rate(double t) { return amplitude * omega * std::cos(omega * t); }

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

struct Point {
  double t = 0, estimate = 0;
};

// What is left of the estimates if they are truth(t - delay) plus a constant.
std::vector<double> residuals(const std::vector<Point>& points, double delay) {
  std::vector<double> left;
  for (const Point& one : points) left.push_back(one.estimate - yaw(one.t - delay));
  const double offset = mean(left);
  for (double& one : left) one -= offset;
  return left;
}
double squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

// The best delay [s] by steps that become smaller.
double best_delay(const std::vector<Point>& points) {
  double best = 0, from = -0.2, to = 1.0;
  for (const double step : {1e-2, 5e-4, 2e-5}) {
    double least = HUGE_VAL;
    for (double delay = from; delay < to + step / 2; delay += step) {
      const double sum = squares(residuals(points, delay));
      if (sum >= least) continue;
      least = sum;
      best = delay;
    }
    from = std::max(-0.2, best - step);
    to = std::min(1.0, best + step);
  }
  return best;
}

Judged delay(const PlainRun& of, const DelayBelow& rule) {
  const Stretch window{.window = rule.window};
  const auto rows = of.rows_in(window);
  if (const std::string why = of.silence(rows, window); !why.empty()) return fail(why);
  std::vector<double> estimates;
  for (const Row& row : rows) estimates.push_back(row.answer.rate.yaw);
  if (const std::string why = PlainRun::not_numbers(rows, estimates); !why.empty()) return fail(why);
  std::vector<double> known;  // the times of all answers whose truth is known
  for (const Row& row : of.rows) {
    if (std::isfinite(row.yaw)) known.push_back(s(row.t_us));
  }
  std::vector<Point> points;  // with 1 s of truth before them and 0.2 s after them
  for (const Row& row : rows) {
    const double t = s(row.t_us);
    if (t - 1.0 >= known.front() && t + 0.2 <= known.back()) points.push_back({t, row.answer.rate.yaw});
  }
  if (points.size() < 20) return not_measured("");
  const double best = best_delay(points);
  const std::vector<double> left = residuals(points, best);
  std::vector<double> rates;
  for (const Point& one : points) rates.push_back(yaw_rate(one.t - best));
  const double mean_rate = mean(rates);
  for (double& one : rates) one -= mean_rate;
  double successive = 0;
  for (std::size_t i = 1; i < left.size(); ++i) successive += left[i] * left[i - 1];
  const double r = std::clamp(successive / squares(left), 0.0, 0.999);
  const double variance = squares(left) / static_cast<double>(left.size() - 2) * (1 + r) / (1 - r);
  const double half_width = 1.96 * std::sqrt(variance / squares(rates));
  if (half_width > 0.05) return not_measured("");
  const std::string measured = fmt::format("{:.1f} +- {:.1f} ms", best * 1e3, half_width * 1e3);
  const double bar = s(rule.below_us);
  if (best + half_width < bar) return of.unless_missing(passes_if(true, measured), window);
  if (best - half_width >= bar) return fail(measured);
  return not_measured("");
}

// The reason why a delay is not known is not compared. The judges know the truth between the samples with
// different accuracy, so their times may differ by the last digit.
void expect_same(const Judged& found, const Judged& expected) {
  ASSERT_EQ(found.outcome, expected.outcome) << found.measured << ", expected " << expected.measured;
  if (expected.measured.empty()) return;
  if (expected.measured.find("+-") == std::string::npos) return expect_equal(found, expected);
  const auto width = [](const std::string& text) { return std::stod(text.substr(text.find("+-") + 2)); };
  EXPECT_NEAR(std::stod(found.measured), std::stod(expected.measured), 0.11);
  EXPECT_NEAR(width(found.measured), width(expected.measured), 0.11);
}

class SlowJudgeOfDelays : public SlowJudge {
 protected:
  SlowJudgeOfDelays() {
    for (std::size_t i = 0; i < flight_.epochs.size(); ++i)
      flight_.epochs[i].los_rate.yaw = yaw(s(flight_.epochs[i].t_us));
  }
};

TEST_F(SlowJudgeOfDelays, AgreesAboutDelays) {
  const auto draw = [](Drawn& run) {
    const double late = run.one_of({-0.05, 0, 0.03, 0.09}), noise = run.one_of({0, 0, 0.02, 0.5});
    for (auto& [t_ns, answer] : run.answers) {
      const double t = s(answer.cause_us);
      answer.rate.yaw += yaw(t - late) - yaw(t) + noise * run.normal();
    }
    return DelayBelow{.judged = {.estimator = "los_rate", .quantity = &quantities::los_rate_yaw},
                      .window = window(run),
                      .below_us = std::llround(run.one_of({5e3, 5e4, 1e5}))};
  };
  expect_agreement({Outcome::pass, Outcome::fail, Outcome::not_measured}, draw, delay, 150, expect_same);
}

}  // namespace
}  // namespace canhil::checks
