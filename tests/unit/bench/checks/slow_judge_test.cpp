// Random series of answers, judged twice: by the checks of the bench, and by a judge that is written in the
// plainest way. For each sample of the flight, the plain judge looks through all answers for those that name
// the sample. Answers are lost, late, given twice, out of order, not a number, and silent for a while or from
// a time on.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/convergence.hpp"
#include "bench/checks/kinds/honest.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/checks/kinds/sigma_grows.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/los_rate/miss_distance.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::checks {
namespace {

using estimators::LosAnswer;
using estimators::LosAnswers;
using messages::LosRateOutcome;
using quantities::Quantity;

constexpr std::int64_t ms_us = 1000, second_us = 1'000'000, period_us = 10 * ms_us;
constexpr std::int64_t duration_us = 6 * second_us, passage_us = 5 * second_us;
constexpr double longest_wait_us = 1.01e6;  // one period and a second
constexpr double mrad = 1e-3;

// A fly-past at 1000 m/s from 5 km, sampled at 100 Hz.
world::EngagementRecord flown() {
  world::EngagementRecord record;
  for (std::int64_t t_us = period_us; t_us < passage_us; t_us += period_us) {
    world::EngagementTruth epoch;
    epoch.t_us = t_us;
    epoch.range = 5000 - 1e-3 * static_cast<double>(t_us);
    epoch.closing_speed = 1000;
    epoch.velocity_n = {-1000, 0, 0};
    epoch.los_rate = {.pitch = 0.01, .yaw = -0.02};
    record.epochs.push_back(epoch);
  }
  record.miss_n = world::Vector3(0, 0.3, 0.4);
  record.passage_us = passage_us;
  return record;
}

// Draws the answers of one flight.
class Drawn {
 public:
  explicit Drawn(unsigned seed, const world::EngagementRecord& flight) : random_(seed) {
    struct Sent {
      std::int64_t arrival_us = 0;
      LosAnswer answer;
    };
    const double lost = one_of({0, 0, 0.02, 0.3, 0.6}), late = one_of({0, 0.01, 0.5}),
                 twice = one_of({0, 0, 0.05}), wrong = one_of({0, 0, 0, 0.001}), blind = one_of({0, 0.2}),
                 coasting = one_of({0, 0.1}), scale = one_of({0.3, 1, 3});
    const double most_late_us = one_of({15e3, 100e3, 2e6});
    const double silent_from_us = one_of({1e9, 1e9, uniform() * 5e6}),
                 silent_for_us = one_of({1e9, 2e5, 1.2e6});
    std::vector<Sent> sent;
    for (const world::EngagementTruth& epoch : flight.epochs) {
      const auto t_us = static_cast<double>(epoch.t_us);
      if (uniform() < lost || (t_us >= silent_from_us && t_us < silent_from_us + silent_for_us)) continue;
      for (int times = uniform() < twice ? 2 : 1; times > 0; --times) {
        LosAnswer answer;
        answer.cause_us = epoch.t_us;
        answer.outcome = uniform() < coasting ? LosRateOutcome::coasting : LosRateOutcome::updated;
        if (epoch.t_us < 3 * period_us) answer.outcome = LosRateOutcome::waiting;
        answer.blind = uniform() < blind;
        answer.rate = {.pitch = epoch.los_rate.pitch + error(scale),
                       .yaw = epoch.los_rate.yaw + error(scale)};
        answer.rate_sigma = {.pitch = sigma(t_us), .yaw = sigma(t_us)};
        answer.nis = -2 * std::log(1 - uniform());
        for (double* value : {&answer.rate.pitch, &answer.rate.yaw, &answer.rate_sigma.pitch, &answer.nis}) {
          if (uniform() < wrong) *value = uniform() < 0.5 ? NAN : HUGE_VAL;
        }
        const double lateness_us = uniform() < late ? uniform() * most_late_us : 500;
        sent.push_back({.arrival_us = epoch.t_us + std::llround(lateness_us), .answer = answer});
      }
    }
    std::ranges::stable_sort(sent, {}, &Sent::arrival_us);
    for (const Sent& one : sent) arrived.push_back(one.answer);
  }
  double uniform() { return std::uniform_real_distribution<double>()(random_); }
  double one_of(const std::vector<double>& values) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random_)];
  }

  std::vector<LosAnswer> arrived;  // in order of arrival

 private:
  double error(double scale) {
    const double outlier = uniform() < 0.005 ? 10 : 1;
    return outlier * scale * mrad * std::normal_distribution<double>()(random_);
  }
  double sigma(double t_us) { return (1 + uniform() + t_us * 2e-7) * mrad; }
  std::mt19937 random_;
};

struct Judged {
  Outcome outcome = Outcome::not_measured;
  std::string measured;
};
std::ostream& operator<<(std::ostream& to, const Judged& one) {
  return to << name(one.outcome) << ": " << one.measured;
}
bool operator==(const Judged& a, const Judged& b) {
  return a.outcome == b.outcome && a.measured == b.measured;
}

Judged fail(std::string why) { return {Outcome::fail, std::move(why)}; }
Judged passes_if(bool holds, std::string measured) {
  return {holds ? Outcome::pass : Outcome::fail, std::move(measured)};
}
double s(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

// The plain judge.
class PlainJudge {
 public:
  // One answer with an estimate, and the truth of its sample.
  struct Row {
    std::int64_t t_us = 0;
    double to_go_s = 0;
    double pitch = 0, yaw = 0;  // errors
    LosAnswer answer;
  };
  PlainJudge(const std::vector<LosAnswer>& arrived, const world::EngagementRecord& flight) : flight_(flight) {
    for (const world::EngagementTruth& epoch : flight.epochs) {
      for (const LosAnswer& answer : arrived) {
        if (answer.cause_us != epoch.t_us) continue;
        all_.push_back(epoch.t_us);
        if (answer.outcome == LosRateOutcome::waiting) continue;
        rows_.push_back({.t_us = epoch.t_us,
                         .to_go_s = epoch.time_to_go(),
                         .pitch = answer.rate.pitch - epoch.los_rate.pitch,
                         .yaw = answer.rate.yaw - epoch.los_rate.yaw,
                         .answer = answer});
      }
    }
  }

  [[nodiscard]] Judged error(const Error& rule) const {
    const auto rows = rows_in(rule.stretch);
    if (const std::string why = silence(rows, rule.stretch); !why.empty()) return fail(why);
    const bool pitch = rule.judged.quantity != &quantities::los_rate_yaw;
    const bool yaw = rule.judged.quantity != &quantities::los_rate_pitch;
    std::vector<double> values, finite_of_answers;
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
      finite_of_answers.push_back(sum);
    }
    if (const std::string why = not_numbers(rows, finite_of_answers, "answers"); !why.empty())
      return fail(why);
    double largest = 0, sum = 0, squares = 0;
    for (const double value : values) {
      largest = std::max(largest, value);
      sum += value;
      squares += value * value;
    }
    const auto count = static_cast<double>(values.size());
    const auto text = [&](const char* statistic, double value) {
      return fmt::format("{} {:.3f} mrad/s of {}", statistic, value / mrad, rows.size());
    };
    switch (rule.statistic) {
      case Error::Statistic::max:
        return passes_if(largest < rule.below, text("max", largest));
      case Error::Statistic::rms:
        return passes_if(std::sqrt(squares / count) < rule.below, text("RMS", std::sqrt(squares / count)));
      case Error::Statistic::mean:
        return passes_if(sum / count < rule.below,
                         fmt::format("mean {:.3f}, max {:.3f} mrad/s of {}", sum / count / mrad,
                                     largest / mrad, rows.size()));
      case Error::Statistic::final:
        return passes_if(last < rule.below, text("final", last));
    }
    return {};
  }

  [[nodiscard]] Judged convergence(const Convergence& rule) const {
    const Stretch to_the_end{.window = {.from_us = rule.before_us, .to_us = duration_us}};
    if (const std::string why = silence(rows_in(to_the_end), to_the_end); !why.empty()) return fail(why);
    std::vector<double> errors;
    for (const Row& row : rows_) errors.push_back(row.yaw);
    if (const std::string why = not_numbers(rows_, errors, "answers"); !why.empty()) return fail(why);
    for (std::size_t first = 0; first < rows_.size(); ++first) {
      bool stays = true;
      for (std::size_t i = first; i < rows_.size(); ++i)
        stays = stays && std::abs(rows_[i].yaw) <= rule.within;
      if (stays)
        return passes_if(rows_[first].t_us < rule.before_us, fmt::format("{:.2f} s", s(rows_[first].t_us)));
    }
    return fail("not within at the end");
  }

  [[nodiscard]] Judged consistency(const Consistency& rule) const {
    std::vector<Row> updates;
    for (const Row& row : rows_in({.window = rule.window})) {
      if (row.answer.outcome == LosRateOutcome::updated) updates.push_back(row);
    }
    if (const std::string why = silence(updates, {.window = rule.window}); !why.empty()) return fail(why);
    std::vector<double> nis;
    double sum = 0;
    for (const Row& row : updates) nis.push_back(row.answer.nis);
    if (const std::string why = not_numbers(updates, nis, "answers"); !why.empty()) return fail(why);
    for (const double one : nis) sum += one;
    const double mean = sum / static_cast<double>(nis.size());
    const auto& [low, high] = std::get<MeanBetween>(rule.bound);
    return passes_if(low <= mean && mean <= high, fmt::format("mean {:.3f} of {}", mean, nis.size()));
  }

  [[nodiscard]] Judged sigma(const Sigma& rule) const {
    const auto rows = rows_in(rule.stretch);
    if (const std::string why = silence(rows, rule.stretch); !why.empty()) return fail(why);
    const auto sigmas = sigmas_of(rows);
    if (const std::string why = not_numbers(rows, sigmas, "sigmas"); !why.empty()) return fail(why);
    double least = HUGE_VAL, most = 0;
    for (const double one : sigmas) {
      least = std::min(least, one);
      most = std::max(most, one);
    }
    return passes_if(rule.low <= least && most <= rule.high,
                     fmt::format("{:.3f} to {:.3f} mrad/s of {}", least / mrad, most / mrad, rows.size()));
  }

  [[nodiscard]] Judged sigma_grows(const SigmaGrows& rule) const {
    const Stretch window{.window = rule.window};
    if (const std::string why = silence(rows_in(window), window); !why.empty()) return fail(why);
    std::vector<Row> rows;
    for (const Row& row : rows_) {
      if (row.t_us <= rule.window.to_us) rows.push_back(row);
    }
    const auto sigmas = sigmas_of(rows);
    double before = sigmas.front();
    bool reported = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].t_us <= rule.window.from_us) before = sigmas[i];
      reported = reported || rows[i].t_us > rule.window.from_us;
    }
    if (!reported) return fail("no sigma is reported in it");
    if (const std::string why = not_numbers(rows, sigmas, "sigmas"); !why.empty()) return fail(why);
    return passes_if(sigmas.back() > rule.by * before,
                     fmt::format("{:.3f} to {:.3f} mrad/s", before / mrad, sigmas.back() / mrad));
  }

  [[nodiscard]] Judged answers(const Answers& rule) const {
    if (all_.empty()) return fail("no answers");
    std::int64_t count = 0;
    for (const std::int64_t t_us : all_)
      count += rule.window.from_us <= t_us && t_us <= rule.window.to_us ? 1 : 0;
    const Answers::Count& wanted = rule.counts.front();
    return passes_if(*wanted.at_least <= count && all_.front() < *wanted.before_us,
                     fmt::format("answers {}, answers at {:g} s", count, s(all_.front())));
  }

 private:
  [[nodiscard]] std::vector<Row> rows_in(const Stretch& stretch) const {
    std::vector<Row> rows;
    for (const Row& row : rows_) {
      const bool in = stretch.to_go_s
                          ? row.to_go_s >= stretch.to_go_s->first && row.to_go_s < stretch.to_go_s->second
                          : row.t_us >= stretch.window.from_us && row.t_us <= stretch.window.to_us;
      if (in) rows.push_back(row);
    }
    return rows;
  }
  static std::vector<double> sigmas_of(const std::vector<Row>& rows) {
    std::vector<double> sigmas;
    for (const Row& row : rows) sigmas.push_back(row.answer.rate_sigma.pitch);
    return sigmas;
  }
  // Where answers are missing; empty: none are.
  [[nodiscard]] std::string silence(const std::vector<Row>& rows, const Stretch& stretch) const {
    if (rows.empty()) return "no answers";
    if (stretch.to_go_s) {
      int samples = 0, answered = 0;
      for (const world::EngagementTruth& epoch : flight_.epochs) {
        if (epoch.time_to_go() < stretch.to_go_s->first || epoch.time_to_go() >= stretch.to_go_s->second)
          continue;
        ++samples;
        bool found = false;
        for (const Row& row : rows) found = found || row.t_us == epoch.t_us;
        answered += found ? 1 : 0;
      }
      return 2 * answered < samples ? fmt::format("answers to {} of {} samples", answered, samples) : "";
    }
    std::vector<std::int64_t> times{stretch.window.from_us};
    for (const Row& row : rows) times.push_back(row.t_us);
    times.push_back(std::min(stretch.window.to_us, passage_us));
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (static_cast<double>(times[i] - times[i - 1]) > longest_wait_us)
        return fmt::format("no answers from {:g} to {:g} s", s(times[i - 1]), s(times[i]));
    }
    return "";
  }
  static std::string not_numbers(const std::vector<Row>& rows, const std::vector<double>& values,
                                 const char* what) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = values.size(); i-- > 0;) {
      if (std::abs(values[i]) <= std::numeric_limits<double>::max()) continue;
      ++count;
      first = i;
    }
    if (count == 0) return "";
    return fmt::format("{} of {} {} are not a number (NaN or infinite), first at {:g} s", count,
                       values.size(), what, s(rows[first].t_us));
  }

  const world::EngagementRecord& flight_;
  std::vector<Row> rows_;          // in order of the samples, and of the arrival of the answers to one sample
  std::vector<std::int64_t> all_;  // the samples of all answers
};

// Judges random flights; each rule is drawn too.
class SlowJudge : public testing::Test {
 protected:
  // Calls judge(drawn, plain) for many flights, and expects that both judges agree. Each outcome must occur.
  template <class Draw, class Plain>
  void expect_agreement(Draw draw, Plain plain) {
    int passed = 0, failed = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
      Drawn drawn(seed, flight_);
      Observations seen;
      for (const world::EngagementTruth& epoch : flight_.epochs) seen.stimuli["Seeker"].add(epoch.t_us);
      seen.of<LosAnswers>() = LosAnswers(drawn.arrived);
      const auto rule = draw(drawn);
      const CheckResult found =
          judged(rule, seen, {.flight = rest_, .duration_us = duration_us, .engagement = &flight_});
      const Judged expected = plain(PlainJudge(drawn.arrived, flight_), rule);
      ASSERT_EQ((Judged{found.outcome, found.measured}), expected)
          << "seed " << seed << ", " << found.expected;
      ++(expected.outcome == Outcome::pass ? passed : failed);
    }
    EXPECT_GT(passed, 20);
    EXPECT_GT(failed, 20);
  }

  static scenario::Window window(Drawn& of) {
    const double from_s = of.one_of({0, 1, 2.5}), to_s = of.one_of({3, 4, 6});
    return {.from_us = std::llround(from_s * 1e6), .to_us = std::llround(to_s * 1e6)};
  }
  static Stretch stretch(Drawn& of) {
    Stretch drawn{.window = window(of)};
    if (of.uniform() < 0.5) drawn.to_go_s = {of.one_of({0.2, 1, 2}), of.one_of({2.5, 4})};
    return drawn;
  }
  static Subject of(const Quantity& quantity) { return {.estimator = "los_rate", .quantity = &quantity}; }

  const world::EngagementRecord flight_ = flown();
  const world::FlightRecord rest_{{.start = {}, .motion = world::Rest{}}, duration_us, 10'000};
};

TEST_F(SlowJudge, AgreesAboutErrors) {
  expect_agreement(
      [](Drawn& drawn) {
        constexpr std::array quantities{&quantities::los_rate_both, &quantities::los_rate_pitch,
                                        &quantities::los_rate_yaw};
        Error rule = error_of("los_rate", *quantities[static_cast<std::size_t>(drawn.uniform() * 3)], {},
                              3 * mrad, static_cast<Error::Statistic>(drawn.uniform() * 4));
        rule.stretch = stretch(drawn);
        return rule;
      },
      [](const PlainJudge& judge, const Error& rule) { return judge.error(rule); });
}

TEST_F(SlowJudge, AgreesAboutConvergence) {
  expect_agreement(
      [](Drawn& drawn) {
        return Convergence{.judged = of(quantities::los_rate_yaw),
                           .within = drawn.one_of({3, 10, 100}) * mrad,
                           .unit = quantities::mradps,
                           .before_us = std::llround(drawn.one_of({1e6, 3e6, 4.9e6})),
                           .end_us = duration_us};
      },
      [](const PlainJudge& judge, const Convergence& rule) { return judge.convergence(rule); });
}

TEST_F(SlowJudge, AgreesAboutConsistency) {
  expect_agreement(
      [](Drawn& drawn) {
        return Consistency{
            .judged = of(quantities::los_nis), .window = window(drawn), .bound = MeanBetween{1.9, 2.2}};
      },
      [](const PlainJudge& judge, const Consistency& rule) { return judge.consistency(rule); });
}

TEST_F(SlowJudge, AgreesAboutSigmas) {
  expect_agreement(
      [](Drawn& drawn) {
        return Sigma{.judged = of(quantities::los_rate_pitch),
                     .stretch = stretch(drawn),
                     .low = mrad,
                     .high = drawn.one_of({2, 3}) * mrad,
                     .unit = quantities::mradps};
      },
      [](const PlainJudge& judge, const Sigma& rule) { return judge.sigma(rule); });
}

TEST_F(SlowJudge, AgreesAboutGrowingSigmas) {
  expect_agreement(
      [](Drawn& drawn) {
        return SigmaGrows{
            .judged = of(quantities::los_rate_pitch), .fault = "", .window = window(drawn), .by = 1.2};
      },
      [](const PlainJudge& judge, const SigmaGrows& rule) { return judge.sigma_grows(rule); });
}

TEST_F(SlowJudge, AgreesAboutAnswers) {
  expect_agreement(
      [](Drawn& drawn) {
        return Answers{.estimator = "los_rate",
                       .window = window(drawn),
                       .counts = {{.mark = "answers", .at_least = 150, .before_us = 20 * ms_us}}};
      },
      [](const PlainJudge& judge, const Answers& rule) { return judge.answers(rule); });
}

}  // namespace
}  // namespace canhil::checks
