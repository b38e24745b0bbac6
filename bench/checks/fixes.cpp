#include "bench/checks/fixes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "bench/checks/errors.hpp"
#include "bench/checks/silence.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::checks {
namespace {

using messages::FixSource;

std::string_view group_of(FixSource source) {
  return source == FixSource::gps ? messages::GpsTime::info.sample_group
                                  : messages::SsblRelativeD::info.sample_group;
}

double component(const world::Vector3& v, scenario::PositionAxis axis) {
  switch (axis) {
    case scenario::PositionAxis::north:
      return v.x();
    case scenario::PositionAxis::east:
      return v.y();
    case scenario::PositionAxis::down:
      return v.z();
    case scenario::PositionAxis::horizontal:
      return v.head<2>().norm();
    case scenario::PositionAxis::norm:
      break;
  }
  return v.norm();
}

// Adds "what value" and its limits to a finding, which fails if they do not hold.
void judge_count(Finding& finding, std::string_view what, std::int64_t value,
                 const std::optional<std::int64_t>& at_least, const std::optional<std::int64_t>& at_most) {
  const auto expect = [&](std::string_view relation, std::int64_t limit, bool holds) {
    finding.expected +=
        fmt::format("{}{} {} {}", finding.expected.empty() ? "" : ", ", what, relation, limit);
    if (!holds) finding.outcome = Outcome::fail;
  };
  finding.measured += fmt::format("{}{} {}", finding.measured.empty() ? "" : ", ", what, value);
  if (at_least) expect(">=", *at_least, value >= *at_least);
  if (at_most) expect("<=", *at_most, value <= *at_most);
}

}  // namespace

std::string unanswered_fixes(const Observations& seen, const scenario::Window& window) {
  std::set<std::pair<FixSource, std::int64_t>> answered;
  for (const FixAnswer& fix : seen.fixes) answered.emplace(fix.source, fix.cause_us);
  std::map<FixSource, int> in_a_row;
  for (const auto& [source, valid_us] : seen.sent_fixes) {
    if (!within(window, valid_us)) continue;
    int& missing = in_a_row[source];
    missing = answered.contains({source, valid_us}) ? 0 : missing + 1;
    if (missing > tolerated_fixes)
      return fmt::format("no answers to {} before {:g} s", group_of(source),
                         static_cast<double>(valid_us) * 1e-6);
  }
  return "";
}

Finding judge(const scenario::PositionError& rule, const Observations& seen,
              const world::FlightRecord& truth) {
  const auto part = inside(position_errors(seen, truth), rule.window);
  const std::string expected = fmt::format("|error| < {:g} m {}", rule.below, seconds(rule.window));
  if (part.empty()) return {Outcome::fail, "no answers", expected};
  if (auto gap = unanswered_fixes(seen, rule.window); !gap.empty())
    return {Outcome::fail, std::move(gap), expected};
  double worst = 0;
  for (const PositionError& error : part)
    worst = std::max(worst, std::abs(component(error.displacement_n, rule.axis)));
  return {pass_if(worst < rule.below), fmt::format("max {:.2f} m of {}", worst, part.size()), expected};
}

Finding judge(const scenario::Fixes& rule, const Observations& seen) {
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = ""};
  for (const scenario::Fixes::Count& count : rule.counts) {
    const auto became = [&](const FixAnswer& answer) {
      return within(rule.window, answer.cause_us) && name_of(answer.outcome) == count.outcome;
    };
    judge_count(finding, count.outcome, std::ranges::count_if(seen.fixes, became), count.at_least,
                count.at_most);
  }
  if (rule.repairs_at_most) {
    judge_count(finding, "repairs", seen.fixes.empty() ? 0 : seen.fixes.back().repairs, {},
                rule.repairs_at_most);
  }
  if (rule.handed_over_before_us) {
    const auto found = std::ranges::find(seen.fixes, true, &FixAnswer::handed_over);
    const bool resolved = found != seen.fixes.end();
    const std::string_view separator = finding.expected.empty() ? "" : ", ";
    finding.expected += fmt::format("{}heading resolved before {:g} s", separator,
                                    static_cast<double>(*rule.handed_over_before_us) * 1e-6);
    finding.measured += resolved ? fmt::format("{}heading resolved at {:g} s", separator,
                                               static_cast<double>(found->cause_us) * 1e-6)
                                 : fmt::format("{}heading never resolved", separator);
    if (!resolved || found->cause_us >= *rule.handed_over_before_us) finding.outcome = Outcome::fail;
  }
  if (seen.fixes.empty()) return {Outcome::fail, "no answers", finding.expected};
  return finding;
}

Finding judge(const scenario::Coasting& rule, const Observations& seen) {
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = ""};
  const auto coasted = [&](const NavigationAnswer& answer) {
    return within(rule.window, answer.cause_us) && answer.coasting;
  };
  const auto coasted_los = [&](const LosAnswer& answer) {
    return within(rule.window, answer.cause_us) && answer.outcome == messages::LosRateOutcome::coasting;
  };
  judge_count(finding, "coasting answers",
              std::ranges::count_if(seen.navigation, coasted) +
                  std::ranges::count_if(seen.fix_navigation, coasted) +
                  std::ranges::count_if(seen.los, coasted_los),
              rule.at_least, rule.at_most);
  if (seen.navigation.empty() && seen.fix_navigation.empty() && seen.los.empty())
    return {Outcome::fail, "no answers", finding.expected};
  return finding;
}

}  // namespace canhil::checks
