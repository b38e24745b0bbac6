// Checks of values against the plain judge: error, convergence, consistency, sigma, sigma_grows, answers,
// miss_distance.
#include <array>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/convergence.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/checks/kinds/sigma_grows.hpp"
#include "bench/estimators/los_rate/miss_distance.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "tests/unit/bench/checks/slow_judge.hpp"

namespace canhil::checks {
namespace {

using quantities::Quantity;

constexpr double mrad = 1e-3;

Judged error(const PlainRun& run, const Error& rule) {
  const auto rows = run.rows_in(rule.stretch);
  if (const std::string why = run.silence(rows, rule.stretch); !why.empty()) return fail(why);
  const bool pitch = rule.judged.quantity != &quantities::los_rate_yaw;
  const bool yaw = rule.judged.quantity != &quantities::los_rate_pitch;
  std::vector<double> values, of_answers;
  double last = 0;
  for (const Row& row : rows) {
    last = 0;
    double sum = 0;
    for (const auto& [judged, error] : {std::pair(pitch, row.pitch), std::pair(yaw, row.yaw)}) {
      if (!judged) continue;
      values.push_back(std::abs(error));
      last = std::max(last, std::abs(error));
      sum += std::abs(error);
    }
    of_answers.push_back(sum);
  }
  if (const std::string why = PlainRun::not_numbers(rows, of_answers); !why.empty()) return fail(why);
  double largest = 0, sum = 0, squares = 0;
  for (const double value : values) {
    largest = std::max(largest, value);
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  const auto verdict = [&](const char* statistic, double value, const std::string& more = "") {
    return run.unless_missing(passes_if(value < rule.below, fmt::format("{} {:.3f}{} mrad/s of {}", statistic,
                                                                        value / mrad, more, rows.size())),
                              rule.stretch);
  };
  switch (rule.statistic) {
    case Error::Statistic::max:
      return verdict("max", largest);
    case Error::Statistic::rms:
      return verdict("RMS", std::sqrt(squares / count));
    case Error::Statistic::mean:
      return verdict("mean", sum / count, fmt::format(", max {:.3f}", largest / mrad));
    case Error::Statistic::final:
      return verdict("final", last);
  }
  return {};
}

Judged convergence(const PlainRun& run, const Convergence& rule) {
  const Stretch to_the_end{.window = {.from_us = rule.before_us, .to_us = run.duration_us}};
  if (const std::string why = run.silence(run.rows_in(to_the_end), to_the_end); !why.empty())
    return fail(why);
  std::vector<double> errors;
  for (const Row& row : run.rows) errors.push_back(row.yaw);
  if (const std::string why = PlainRun::not_numbers(run.rows, errors); !why.empty()) return fail(why);
  for (std::size_t first = 0; first < errors.size(); ++first) {
    bool stays = true;
    for (std::size_t i = first; i < errors.size(); ++i) stays = stays && std::abs(errors[i]) <= rule.within;
    const std::int64_t t_us = run.rows[first].t_us;
    if (stays)
      return run.unless_missing(passes_if(t_us < rule.before_us, fmt::format("{:.2f} s", s(t_us))),
                                run.whole());
  }
  return fail("not within at the end");
}

Judged consistency(const PlainRun& run, const Consistency& rule) {
  std::vector<Row> updates;
  std::vector<double> nis;
  for (const Row& row : run.rows_in({.window = rule.window})) {
    if (row.answer.outcome != messages::LosRateOutcome::updated) continue;
    updates.push_back(row);
    nis.push_back(row.answer.nis);
  }
  if (const std::string why = run.silence(updates, {.window = rule.window}); !why.empty()) return fail(why);
  if (const std::string why = PlainRun::not_numbers(updates, nis); !why.empty()) return fail(why);
  double sum = 0;
  for (const double one : nis) sum += one;
  const double mean = sum / static_cast<double>(nis.size());
  const auto& [low, high] = std::get<MeanBetween>(rule.bound);
  return run.unless_missing(
      passes_if(low <= mean && mean <= high, fmt::format("mean {:.3f} of {}", mean, nis.size())),
      {.window = rule.window});
}

std::vector<double> sigmas_of(const std::vector<Row>& rows) {
  std::vector<double> sigmas;
  for (const Row& row : rows) sigmas.push_back(row.answer.rate_sigma.pitch);
  return sigmas;
}

Judged sigma(const PlainRun& run, const Sigma& rule) {
  const auto rows = run.rows_in(rule.stretch);
  if (const std::string why = run.silence(rows, rule.stretch); !why.empty()) return fail(why);
  const auto sigmas = sigmas_of(rows);
  if (const std::string why = PlainRun::not_numbers(rows, sigmas, "sigmas"); !why.empty()) return fail(why);
  double least = HUGE_VAL, most = 0;
  for (const double one : sigmas) {
    least = std::min(least, one);
    most = std::max(most, one);
  }
  return run.unless_missing(
      passes_if(rule.low <= least && most <= rule.high,
                fmt::format("{:.3f} to {:.3f} mrad/s of {}", least / mrad, most / mrad, rows.size())),
      rule.stretch);
}

Judged sigma_grows(const PlainRun& run, const SigmaGrows& rule) {
  if (run.run.fault && run.run.fault->count == 0) return not_measured("the fault 'it' did not strike");
  const Stretch window{.window = rule.window};
  const std::string silence = run.silence(run.rows_in(window), window);
  if (rule.fault.empty() && !silence.empty()) return fail(silence);  // in a fault there may be silence
  const std::vector<Row> rows = run.rows_in({.window = {.from_us = 0, .to_us = rule.window.to_us}});
  const auto sigmas = sigmas_of(rows);
  std::optional<double> before;
  bool reported = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].t_us <= rule.window.from_us || !before) before = sigmas[i];
    reported = reported || rows[i].t_us > rule.window.from_us;
  }
  if (!reported) return fail("no sigma is reported in it");
  if (const std::string why = PlainRun::not_numbers(rows, sigmas, "sigmas"); !why.empty()) return fail(why);
  return run.unless_missing(
      passes_if(sigmas.back() > rule.by * *before,
                fmt::format("{:.3f} to {:.3f} mrad/s", *before / mrad, sigmas.back() / mrad)),
      window);
}

Judged answers(const PlainRun& run, const Answers& rule) {
  if (run.all.empty()) return fail("no answers");
  const Answers::Count& wanted = rule.counts.front();
  std::int64_t count = 0;
  if (wanted.mark == "answers") {
    for (const std::int64_t t_us : run.all) count += lies_in(rule.window, t_us) ? 1 : 0;
    return passes_if(*wanted.at_least <= count && run.all.front() < *wanted.before_us,
                     fmt::format("answers {}, answers at {:g} s", count, s(run.all.front())));
  }
  for (const Row& row : run.rows_in({.window = rule.window}))
    count += row.answer.outcome == messages::LosRateOutcome::coasting ? 1 : 0;
  return run.unless_missing(passes_if(count <= *wanted.at_most, fmt::format("coasting {}", count)),
                            {.window = rule.window});
}

class SlowJudgeOfValues : public SlowJudge {
 protected:
  static Stretch stretch(Drawn& of) {
    Stretch drawn{.window = window(of)};
    if (of.uniform() < 0.5) drawn.to_go_s = {of.one_of({0.2, 1, 2}), of.one_of({2.5, 4})};
    return drawn;
  }
  static Subject of(const Quantity& quantity) { return {.estimator = "los_rate", .quantity = &quantity}; }

  const std::vector<Outcome> each_{Outcome::pass, Outcome::fail, Outcome::not_measured};
};

TEST_F(SlowJudgeOfValues, AgreesAboutErrors) {
  const auto draw = [](Drawn& run) {
    constexpr std::array quantities{&quantities::los_rate_both, &quantities::los_rate_pitch,
                                    &quantities::los_rate_yaw};
    Error rule = error_of("los_rate", *quantities[static_cast<std::size_t>(run.uniform() * 3)], {},
                          run.one_of({2, 6}) * mrad, static_cast<Error::Statistic>(run.uniform() * 4));
    rule.stretch = stretch(run);
    return rule;
  };
  expect_agreement(each_, draw, error);
}

TEST_F(SlowJudgeOfValues, AgreesAboutConvergence) {
  const auto draw = [](Drawn& run) {
    return Convergence{.judged = of(quantities::los_rate_yaw),
                       .within = run.one_of({3, 10, 100}) * mrad,
                       .unit = quantities::mradps,
                       .before_us = std::llround(run.one_of({1e6, 3e6, 4.9e6})),
                       .end_us = duration_us};
  };
  expect_agreement(each_, draw, convergence);
}

TEST_F(SlowJudgeOfValues, AgreesAboutConsistency) {
  const auto draw = [](Drawn& run) {
    return Consistency{
        .judged = of(quantities::los_nis), .window = window(run), .bound = MeanBetween{1.9, 2.2}};
  };
  expect_agreement(each_, draw, consistency);
}

TEST_F(SlowJudgeOfValues, AgreesAboutSigmas) {
  const auto draw = [](Drawn& run) {
    return Sigma{.judged = of(quantities::los_rate_pitch),
                 .stretch = stretch(run),
                 .low = mrad,
                 .high = run.one_of({2, 3}) * mrad,
                 .unit = quantities::mradps};
  };
  expect_agreement(each_, draw, sigma);
}

TEST_F(SlowJudgeOfValues, AgreesAboutGrowingSigmas) {
  const auto draw = [](Drawn& run) {
    SigmaGrows rule{.judged = of(quantities::los_rate_pitch),
                    .fault = "",
                    .window = window(run),
                    .by = run.one_of({0.7, 1.2})};
    if (run.uniform() < 0.3) {
      rule.fault = "it";
      run.fault = FaultRecord{.name = "it",
                              .window = rule.window,
                              .valid_from_us = rule.window.from_us,
                              .count = run.uniform() < 0.5 ? 1U : 0U};
    }
    return rule;
  };
  expect_agreement(each_, draw, sigma_grows);
}

TEST_F(SlowJudgeOfValues, AgreesAboutAnswers) {
  const auto draw = [](Drawn& run) {
    Answers rule{
        .estimator = "los_rate", .window = window(run), .counts = {{.mark = "coasting", .at_most = 1}}};
    if (run.uniform() < 0.5) rule.counts = {{.mark = "answers", .at_least = 150, .before_us = 20'000}};
    return rule;
  };
  expect_agreement(each_, draw, answers);
}

// A run in which the flight does not follow the answers: only the flight decides.
TEST_F(SlowJudgeOfValues, AgreesAboutTheMiss) {
  const auto draw = [&](Drawn& run) {
    flight_.miss_n.reset();
    if (run.uniform() < 0.8) flight_.miss_n = world::Vector3(run.normal(), run.normal(), run.normal());
    return estimators::MissDistance{.below = 1.5};
  };
  const auto plain = [](const PlainRun& run, const estimators::MissDistance& rule) {
    if (!run.flight.miss_n) return fail("the missile did not pass the target before the end");
    const world::Vector3& miss = *run.flight.miss_n;
    const double metres = std::sqrt(miss.x() * miss.x() + miss.y() * miss.y() + miss.z() * miss.z());
    return passes_if(metres < rule.below, fmt::format("{:.3f} m", metres));
  };
  expect_agreement({Outcome::pass, Outcome::fail}, draw, plain, 100);
}

}  // namespace
}  // namespace canhil::checks
