#include "bench/checks/kinds/answering.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/evidence.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/checks/silence.hpp"

namespace canhil::checks {
namespace {

// How many values or sigmas of a quantity are not finite; empty: all are finite.
std::string no_number(const Evidence& evidence, const std::vector<Subject>& subjects) {
  for (const Subject& subject : subjects) {
    for (const quantities::Track* track : tracks_of(evidence, subject.estimator, *subject.quantity)) {
      NotFinite not_finite;
      for (const quantities::TrackPoint& point : track->points)
        not_finite.take(point.t_us, point.value, point.sigma.value_or(0));
      if (const std::string why = not_finite.to_text(track->points.size()); !why.empty())
        return fmt::format("{}: {}", subject.text, why);
    }
  }
  return {};
}

}  // namespace

std::vector<scenario::Window> without(const scenario::Window& whole, std::vector<scenario::Window> others) {
  std::ranges::sort(others, {}, &scenario::Window::from_us);
  std::vector<scenario::Window> left;
  std::int64_t from_us = whole.from_us;
  for (const scenario::Window& other : others) {
    if (other.from_us > from_us)
      left.push_back({.from_us = from_us, .to_us = std::min(other.from_us, whole.to_us)});
    from_us = std::max(from_us, other.to_us);
  }
  if (from_us < whole.to_us) left.push_back({.from_us = from_us, .to_us = whole.to_us});
  std::erase_if(left, [](const scenario::Window& one) { return one.from_us >= one.to_us; });
  return left;
}

Answering Answering::read(scenario::Section& /*section*/, const scenario::CheckContext& context) {
  Answering rule;
  for (const estimators::Estimator* one : running(context)) {
    const std::vector<Subject> reported = always_reported(*one);
    rule.judged.insert(rule.judged.end(), reported.begin(), reported.end());
  }
  return rule;
}

Finding Answering::judge(const Evidence& evidence) const {
  const Expected expected{.text = "answers and heartbeats without a gap, all numbers, whole frames"};
  const auto failed = [&](std::string why) { return Finding{Outcome::fail, std::move(why), expected}; };
  const Observations& seen = evidence.seen;
  if (seen.spoilt_from_target() > 0)
    return failed(fmt::format("{} frames of the target with a wrong CRC or size", seen.spoilt_from_target()));
  if (auto wrong = no_number(evidence, judged); !wrong.empty()) return failed(std::move(wrong));
  std::size_t values = 0;
  for (const Subject& subject : judged) {
    for (const quantities::Track* track : tracks_of(evidence, subject.estimator, *subject.quantity))
      values += track->points.size();
  }
  if (values == 0) return failed("no answers");
  std::vector<scenario::Window> struck;  // a fault that did not strike excuses nothing
  // A sample that was measured before a fault may be transmitted during the fault.
  for (const auto& fault : seen.faults) {
    if (did_not_strike(evidence, fault.name).empty())
      struck.push_back({.from_us = fault.valid_from_us, .to_us = fault.window.to_us});
  }
  const scenario::Window whole{.from_us = 0, .to_us = evidence.truth.duration_us};
  for (const scenario::Window& stretch : without(whole, struck)) {
    if (auto gap = silence_of(evidence, judged, stretch); !gap.empty()) return failed(std::move(gap));
  }
  const double longest = longest_wait_us(static_cast<double>(messages::TargetHeartbeat::info.cycle_time_us));
  for (const scenario::Window& silence : seen.complaints.silences()) {
    for (const scenario::Window& owed : without(silence, struck)) {
      if (static_cast<double>(owed.to_us - owed.from_us) > longest)
        return failed("no heartbeat " + seconds(owed));
    }
  }
  return {Outcome::pass, fmt::format("{} values", values), expected, {.count = values}};
}

}  // namespace canhil::checks
