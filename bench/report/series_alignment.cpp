// Series of the estimators of attitude and velocity.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/report/series_parts.hpp"
#include "bench/report/summary.hpp"

namespace canhil::report {
namespace {

using checks::Observations;
using scenario::Aligner;
using scenario::VelocityAxis;
using Kind = Series::Kind;

constexpr auto t_us = [](const auto& item) { return item.t_us; };
constexpr auto cause_us = [](const auto& item) { return item.cause_us; };
constexpr std::array axes{"north", "east", "down"};
constexpr std::array velocity_axes{VelocityAxis::north, VelocityAxis::east, VelocityAxis::down};

// The longest time that is no silence between answers to fixes: so many in a row may go unanswered. By the
// median, as the bench may keep fixes back on purpose; of two sources the slower one counts.
double longest_fix_wait_us(const Observations& seen) {
  double period_us = 0;
  for (const messages::FixSource source : messages::enumerators<messages::FixSource>) {
    std::vector<std::int64_t> periods_us;
    std::optional<std::int64_t> before_us;
    for (const checks::SentFix& fix : seen.sent_fixes) {
      if (fix.source != source) continue;
      if (before_us) periods_us.push_back(fix.valid_us - *before_us);
      before_us = fix.valid_us;
    }
    if (periods_us.empty()) continue;
    const auto middle = periods_us.begin() + static_cast<std::ptrdiff_t>(periods_us.size() / 2);
    std::ranges::nth_element(periods_us, middle);
    period_us = std::max(period_us, static_cast<double>(*middle));
  }
  return checks::longest_wait_us(period_us, checks::tolerated_fixes + 1);
}

double misalignment_sigma(const checks::FilterAnswer& answer, int axis) {
  return answer.attitude_sigma(axis);
}
double misalignment_sigma(const checks::FixAnswer& answer, int axis) {
  return axis == 0 ? answer.tilt_sigma_north : axis == 1 ? answer.tilt_sigma_east : answer.heading_sigma;
}

// The series of one alignment, whose filter gives `Answers`.
template <class Answers>
class Alignment {
 public:
  Alignment(std::vector<Series>& all, Aligner aligner, const run::Run& run, std::int64_t duration_us,
            const Answers& answers, double filter_wait_us)
      : all_(all),
        aligner_(aligner),
        seen_(run.seen),
        navigation_(checks::navigation_of(run.seen, aligner)),
        errors_(checks::navigation_errors(navigation_, run.truth)),
        answers_(answers),
        span_{.duration_us = duration_us, .end_us = duration_us},
        filter_wait_us_(filter_wait_us) {
    const auto& message = aligner == Aligner::inflight_alignment ? messages::FixVelocityD::info
                                                                 : messages::AlignVelocityD::info;
    navigation_wait_us_ = checks::longest_wait_us(1e6 * checks::nominal_period_s(seen_, message.name));
  }

  void add() {
    const scenario::AngleUnit unit = angle_unit(aligner_);
    add_heading();
    for (int axis = 0; axis < 3; ++axis) {
      add_error(
          empty(std::string("attitude error about ") + axes[static_cast<std::size_t>(axis)], unit),
          [=](const auto& e) { return e.misalignment(axis) / unit.factor; },
          [=](const auto& a) { return std::optional(misalignment_sigma(a, axis) / unit.factor); });
    }
    add_judged_attitude(unit);
    for (int axis = 0; axis < 3; ++axis) {
      add_error(
          empty(error_of(velocity_axes[static_cast<std::size_t>(axis)]), metres_per_second),
          [=](const auto& e) { return e.v_eb_n(axis); },
          [=](const auto& a) { return std::optional(a.velocity_sigma(axis)); });
    }
    add_error(
        judged(empty(error_of(VelocityAxis::norm), metres_per_second)),
        [](const auto& e) { return e.v_eb_n.norm(); }, [](const auto&) { return std::optional<double>(); });
    for (int axis = 0; axis < 3; ++axis) {
      const bool by_fixes = aligner_ == Aligner::inflight_alignment;
      Series series = empty(std::string("innovation ") + axes[static_cast<std::size_t>(axis)],
                            by_fixes ? metres : metres_per_second);
      series.kind = Kind::innovation;
      all_.push_back(thinned(std::move(series), span_, filter_wait_us_, answers_, cause_us,
                             [=](const auto& a) { return Sample{.value = a.innovation(axis)}; }));
    }
    all_.push_back(nis_series(name(aligner_), span_, filter_wait_us_, checks::nis(seen_, aligner_), 3));
  }

 private:
  static constexpr scenario::AngleUnit metres{"m", 1}, metres_per_second{"m/s", 1};

  [[nodiscard]] Series empty(std::string quantity, const scenario::AngleUnit& unit) const {
    return {.estimator = std::string(name(aligner_)),
            .quantity = std::move(quantity),
            .unit = std::string(unit.name),
            .unit_si = unit.factor};
  }
  static Series judged(Series series) {
    series.only_if_judged = true;
    return series;
  }

  // An error with the sigma of the last filter answer before it, as long as that one is not stale.
  template <class Error, class Sigma>
  void add_error(Series series, Error error, Sigma sigma) {
    auto next = answers_.begin();
    all_.push_back(thinned(std::move(series), span_, navigation_wait_us_, errors_, t_us,
                           [&](const checks::NavigationError& e) {
                             while (next != answers_.end() && next->cause_us <= e.t_us) ++next;
                             Sample sample{.value = error(e)};
                             if (next == answers_.begin()) return sample;
                             const auto& last = *std::prev(next);
                             if (static_cast<double>(e.t_us - last.cause_us) <= filter_wait_us_)
                               sample.sigma = sigma(last);
                             return sample;
                           }));
  }

  // Heading and its truth, without a jump where they pass south.
  void add_heading() {
    Series series = empty("heading", scenario::degrees);
    series.kind = Kind::estimate;
    double truth = 0;
    all_.push_back(thinned(
        std::move(series), span_, navigation_wait_us_, errors_, t_us, [&](const checks::NavigationError& e) {
          const auto& answer = *std::ranges::lower_bound(navigation_, e.t_us, {}, cause_us);
          const double now = answer.angles.heading - e.angles.heading;
          truth += std::remainder(now - truth, 2 * std::numbers::pi);
          return Sample{.value = (truth + e.angles.heading) / scenario::degrees.factor,
                        .sigma = {},
                        .truth = truth / scenario::degrees.factor};
        }));
  }

  // The Euler angles that checks judge. Sigmas of roll and pitch are not told: those of the tilts are.
  void add_judged_attitude(const scenario::AngleUnit& unit) {
    using scenario::AttitudeAxis;
    const auto add_angle = [&](AttitudeAxis axis, double world::Euler::*angle) {
      add_error(
          judged(empty(error_of(axis), unit)), [=](const auto& e) { return e.angles.*angle / unit.factor; },
          [=](const auto& a) {
            return axis == AttitudeAxis::heading ? std::optional(misalignment_sigma(a, 2) / unit.factor)
                                                 : std::nullopt;
          });
    };
    add_angle(AttitudeAxis::heading, &world::Euler::heading);
    add_angle(AttitudeAxis::roll, &world::Euler::roll);
    add_angle(AttitudeAxis::pitch, &world::Euler::pitch);
  }

  std::vector<Series>& all_;
  Aligner aligner_;
  const Observations& seen_;
  const std::vector<checks::NavigationAnswer>& navigation_;
  std::vector<checks::NavigationError> errors_;
  const Answers& answers_;
  Span span_;
  double navigation_wait_us_ = 0;
  double filter_wait_us_;
};

void add_position(std::vector<Series>& all, const run::Run& run, const Span& span, double wait_us) {
  using scenario::PositionAxis;
  std::vector<checks::FixAnswer> told;
  std::ranges::copy_if(run.seen.fixes, std::back_inserter(told),
                       [&](const auto& fix) { return checks::tells_of_its_time(fix, run.truth); });
  const auto add = [&](PositionAxis axis, bool only_if_judged, auto sample) {
    Series series{.estimator = std::string(name(Aligner::inflight_alignment)),
                  .quantity = error_of(axis),
                  .unit = "m",
                  .only_if_judged = only_if_judged};
    all.push_back(thinned(
        std::move(series), span, wait_us, told, cause_us,
        [&](const checks::FixAnswer& fix) { return sample(fix, checks::position_error(fix, run.truth)); }));
  };
  int component = 0;
  for (const PositionAxis axis : {PositionAxis::north, PositionAxis::east, PositionAxis::down}) {
    add(axis, false, [component](const checks::FixAnswer& fix, const world::Vector3& error) {
      return Sample{.value = error(component), .sigma = fix.position_sigma(component)};
    });
    ++component;
  }
  add(PositionAxis::horizontal, true,
      [](const auto&, const world::Vector3& error) { return Sample{.value = error.head<2>().norm()}; });
  add(PositionAxis::norm, true,
      [](const auto&, const world::Vector3& error) { return Sample{.value = error.norm()}; });
}

}  // namespace

void add_alignment(std::vector<Series>& all, Aligner aligner, const run::Run& run, std::int64_t duration_us) {
  if (aligner == Aligner::transfer_alignment) {
    const double wait_us =
        checks::longest_wait_us(1e6 * checks::nominal_period_s(run.seen, messages::AlignUpdate::info.name));
    Alignment(all, aligner, run, duration_us, run.seen.filter, wait_us).add();
    return;
  }
  const double wait_us = longest_fix_wait_us(run.seen);
  Alignment(all, aligner, run, duration_us, run.seen.fixes, wait_us).add();
  add_position(all, run, {.duration_us = duration_us, .end_us = duration_us}, wait_us);
}

}  // namespace canhil::report
