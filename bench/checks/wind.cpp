#include "bench/checks/wind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"

namespace canhil::checks {
namespace {

using world::Vector3;

bool lies_within(const WindAnswer& answer, const world::GlideRecord& glide) {
  return answer.started && answer.cause_us >= 0 && answer.cause_us <= glide.end_us() &&
         answer.cause_us % world::GlideRecord::step_us == 0;
}

WindError error_of(const WindAnswer& answer, const world::GlideRecord& glide) {
  const world::GlideTruth& truth = glide.at(answer.cause_us);
  const Vector3 v = truth.C_bn * truth.v_a;
  const Eigen::Vector2d along = Eigen::Vector2d(v.x(), v.y()).normalized();
  const Vector3 error = answer.wind_n - truth.wind_n;
  return {.t_us = answer.cause_us,
          .error_n = error,
          .along_track = along.x() * error.x() + along.y() * error.y(),
          .cross_track = -along.y() * error.x() + along.x() * error.y()};
}

bool has(const WindAnswer& answer, std::string_view flag) {
  if (flag == "outside") return answer.outside;
  if (flag == "fins_late") return answer.fins_late;
  if (flag == "fins_missing") return answer.fins_missing;
  if (flag == "fins_not_physical") return answer.fins_not_physical;
  return flag == "theta_capped" && answer.theta_capped;
}

// The longest stretch of a window in which nothing was answered [us].
std::int64_t longest_gap_us(const std::vector<WindError>& part, const scenario::Window& window,
                            std::int64_t end_us) {
  std::int64_t from_us = window.from_us;
  std::int64_t longest_us = 0;
  for (const WindError& error : part) {
    longest_us = std::max(longest_us, error.t_us - from_us);
    from_us = error.t_us;
  }
  return std::max(longest_us, std::min(window.to_us, end_us) - from_us);
}

}  // namespace

double component(const WindError& error, scenario::WindAxis axis) {
  switch (axis) {
    case scenario::WindAxis::along_track:
      return error.along_track;
    case scenario::WindAxis::cross_track:
      return error.cross_track;
    case scenario::WindAxis::down:
      return error.error_n.z();
    case scenario::WindAxis::norm:
      break;
  }
  return error.error_n.norm();
}

std::vector<WindError> wind_errors(const Observations& seen, const world::GlideRecord& glide) {
  std::vector<WindError> errors;
  for (const WindAnswer& answer : seen.wind) {
    if (lies_within(answer, glide)) errors.push_back(error_of(answer, glide));
  }
  return errors;
}

std::vector<Normalised> wind_nis(const Observations& seen) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : seen.wind) {
    if (answer.outcome == messages::WindOutcome::updated) all.push_back({answer.cause_us, answer.nis});
  }
  return all;
}

std::vector<Normalised> wind_nees(const Observations& seen, const world::GlideRecord& glide) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : seen.wind) {
    if (!lies_within(answer, glide)) continue;
    const Vector3 error = error_of(answer, glide).error_n;
    all.push_back({answer.cause_us, nees(error, answer.sigma, answer.correlation)});
  }
  return all;
}

std::int64_t count_flag(const Observations& seen, const scenario::Window& window, std::string_view flag) {
  return std::ranges::count_if(seen.wind, [&](const WindAnswer& answer) {
    return within(window, answer.cause_us) && has(answer, flag);
  });
}

Finding judge(const scenario::WindError& rule, const Observations& seen, const world::GlideRecord* glide) {
  const bool mean = rule.statistic == scenario::WindStatistic::mean;
  const std::string expected =
      fmt::format("{} |error| < {:g} m/s {}", mean ? "mean" : "max", rule.below, seconds(rule.window));
  if (glide == nullptr) return {Outcome::fail, "no glide to judge against", expected};
  const std::vector<WindError> part = inside(wind_errors(seen, *glide), rule.window);
  if (part.empty()) return {Outcome::fail, "no answers", expected};
  const double longest_us = longest_wait_us(1e6 * nominal_period_s(seen, messages::WindUpdate::info.name));
  if (const std::int64_t gap_us = longest_gap_us(part, rule.window, glide->end_us());
      static_cast<double>(gap_us) > longest_us) {
    return {Outcome::fail, fmt::format("no answers for {:.2f} s", 1e-6 * static_cast<double>(gap_us)),
            expected};
  }
  double sum = 0;
  double worst = 0;
  bool finite = true;
  for (const WindError& error : part) {
    const double value = std::abs(component(error, rule.axis));
    finite = finite && std::isfinite(value);
    sum += value;
    worst = std::max(worst, value);
  }
  const double average = sum / static_cast<double>(part.size());
  return {pass_if(finite && (mean ? average : worst) < rule.below),
          fmt::format("mean {:.3f}, max {:.3f} m/s of {}", average, worst, part.size()), expected};
}

Finding judge(const scenario::WindAnswers& rule, const Observations& seen) {
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = seconds(rule.window)};
  for (const scenario::WindAnswers::Count& wanted : rule.counts) {
    const auto of_outcome = [&](const WindAnswer& answer) {
      return within(rule.window, answer.cause_us) && name_of(answer.outcome) == wanted.name;
    };
    const std::int64_t count = wanted.is_flag ? count_flag(seen, rule.window, wanted.name)
                                              : std::ranges::count_if(seen.wind, of_outcome);
    finding.measured += fmt::format("{}{} {}", finding.measured.empty() ? "" : ", ", wanted.name, count);
    if (wanted.at_least) finding.expected += fmt::format(", {} >= {}", wanted.name, *wanted.at_least);
    if (wanted.at_most) finding.expected += fmt::format(", {} <= {}", wanted.name, *wanted.at_most);
    if ((wanted.at_least && count < *wanted.at_least) || (wanted.at_most && count > *wanted.at_most))
      finding.outcome = Outcome::fail;
  }
  if (seen.wind.empty()) return {Outcome::fail, "no answers", finding.expected};
  return finding;
}

}  // namespace canhil::checks
