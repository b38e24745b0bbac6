// Series of the estimators of wind and LOS rate.
#include <algorithm>
#include <array>
#include <utility>

#include "bench/checks/los.hpp"
#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/checks/wind.hpp"
#include "bench/report/series_parts.hpp"
#include "bench/world/units.hpp"

namespace canhil::report {
namespace {

using world::units::mrad;

constexpr auto t_us = [](const auto& item) { return item.t_us; };
constexpr auto cause_us = [](const auto& item) { return item.cause_us; };

// The answer of a cause, of answers in the order of their causes.
template <class Answers>
const auto& answer_at(const Answers& answers, std::int64_t t) {
  return *std::ranges::lower_bound(answers, t, {}, cause_us);
}

double longest_wait_us(const checks::Observations& seen, std::string_view message) {
  return checks::longest_wait_us(1e6 * checks::nominal_period_s(seen, message));
}

Series of_wind(std::string quantity) {
  return {.estimator = "wind", .quantity = std::move(quantity), .unit = "m/s"};
}

}  // namespace

void add_wind(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us) {
  using checks::WindError;
  using scenario::WindAxis;
  const auto& answers = run.seen.wind;
  const auto errors = checks::wind_errors(run.seen, *run.own_truth.glide);
  const Span span{.duration_us = duration_us, .end_us = run.own_truth.glide->end_us()};
  const double wait_us = longest_wait_us(run.seen, messages::WindUpdate::info.name);
  constexpr std::array axes{"north", "east", "down"};
  for (int axis = 0; axis < 3; ++axis) {
    Series series = of_wind(std::string("wind ") + axes[static_cast<std::size_t>(axis)]);
    series.kind = Series::Kind::estimate;
    all.push_back(thinned(std::move(series), span, wait_us, errors, t_us, [&](const WindError& e) {
      const double estimated = answer_at(answers, e.t_us).wind_n(axis);
      return Sample{.value = estimated, .sigma = {}, .truth = estimated - e.error_n(axis)};
    }));
  }
  for (int axis = 0; axis < 3; ++axis) {
    Series series = of_wind(std::string("wind error ") + axes[static_cast<std::size_t>(axis)]);
    all.push_back(thinned(std::move(series), span, wait_us, errors, t_us, [&](const WindError& e) {
      return Sample{.value = e.error_n(axis), .sigma = answer_at(answers, e.t_us).sigma(axis)};
    }));
  }
  // What checks judge besides.
  for (const WindAxis axis : {WindAxis::along_track, WindAxis::cross_track, WindAxis::norm}) {
    Series series = of_wind(error_of(axis));
    series.only_if_judged = true;
    all.push_back(thinned(std::move(series), span, wait_us, errors, t_us, [&](const WindError& e) {
      const checks::WindAnswer& answer = answer_at(answers, e.t_us);
      Sample sample{.value = component(e, axis)};
      if (axis == WindAxis::along_track) sample.sigma = answer.along_track_sigma;
      if (axis == WindAxis::cross_track) sample.sigma = answer.cross_track_sigma;
      return sample;
    }));
  }
  all.push_back(nis_series("wind", span, wait_us, checks::wind_nis(run.seen), 9));
}

void add_los(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us) {
  using scenario::LosPlane;
  const world::EngagementRecord& engagement = *run.own_truth.engagement;
  auto errors = checks::los_errors(run.seen, engagement);
  // In the last moments before the passage the rate itself grows beyond any picture.
  constexpr double least_to_go_s = 0.08;
  std::erase_if(errors, [](const checks::LosError& e) { return e.time_to_go < least_to_go_s; });
  const Span span{.duration_us = duration_us,
                  .end_us = engagement.miss_n ? std::min(duration_us, engagement.passage_us) : duration_us};
  const double wait_us = longest_wait_us(run.seen, messages::LosRateTarget::info.name);
  struct Plane {
    LosPlane plane;
    double world::Planes<double>::*member;
  };
  const std::array planes{Plane{LosPlane::pitch, &world::Planes<double>::pitch},
                          Plane{LosPlane::yaw, &world::Planes<double>::yaw}};
  const auto add = [&](std::string quantity, Series::Kind kind, auto sample) {
    Series series{.estimator = "los_rate",
                  .quantity = std::move(quantity),
                  .unit = "mrad/s",
                  .unit_si = mrad,
                  .kind = kind};
    all.push_back(thinned(std::move(series), span, wait_us, errors, t_us, [&](const checks::LosError& e) {
      return sample(answer_at(run.seen.los, e.t_us), e);
    }));
  };
  for (const Plane& one : planes) {
    const auto member = one.member;
    add("LOS rate, " + std::string(name(one.plane)), Series::Kind::estimate,
        [member](const checks::LosAnswer& answer, const checks::LosError& e) {
          return Sample{.value = answer.rate.*member / mrad,
                        .sigma = {},
                        .truth = (answer.rate.*member - e.rate.*member) / mrad};
        });
  }
  for (const Plane& one : planes) {
    const auto member = one.member;
    add(error_of(one.plane), Series::Kind::error,
        [member](const checks::LosAnswer& answer, const checks::LosError& e) {
          return Sample{.value = e.rate.*member / mrad, .sigma = answer.rate_sigma.*member / mrad};
        });
  }
  all.push_back(nis_series("los_rate", span, wait_us, checks::los_nis(run.seen), 2));
}

}  // namespace canhil::report
