#include "bench/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "bench/report/latency_tests.hpp"

namespace canhil::report {
namespace {

using checks::Judgement;

// Numbers of runs, ascending.
using Numbers = std::vector<double>;

// A smaller difference is that of rounding on another CPU.
constexpr double same_share = 1e-9;

bool equal(double a, double b) { return std::abs(a - b) <= same_share * std::max(std::abs(a), std::abs(b)); }

Numbers numbers_of(const std::vector<Judgement>& side,
                   const std::function<std::optional<double>(const Judgement&)>& number_of) {
  Numbers numbers;
  for (const Judgement& one : side) {
    if (const auto number = number_of(one)) numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

std::string range(const Numbers& numbers, int digits) {
  const std::string least = fmt::format("{:.{}g}", numbers.front(), digits);
  const std::string most = fmt::format("{:.{}g}", numbers.back(), digits);
  return least == most ? least : least + ".." + most;
}

// With so many digits that a change can be seen.
std::string arrow(const Numbers& before, const Numbers& after) {
  constexpr int usual = 4, most = 10;
  const bool changed = !equal(before.front(), after.front()) || !equal(before.back(), after.back());
  for (int digits = usual;; digits = most) {
    const std::string from = range(before, digits), to = range(after, digits);
    if (from != to || !changed || digits == most) return from + " -> " + to;
  }
}

std::string percent(const Numbers& margins) {
  const auto shown = [](double share) { return fmt::format("{:.1f}", 100 * share); };
  const std::string least = shown(margins.front()), most = shown(margins.back());
  return (least == most ? least : least + ".." + most) + " %";
}

double mean_of(const Numbers& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

}  // namespace

std::optional<FiguresCompared> compare_figures(const std::vector<Judgement>& before,
                                               const std::vector<Judgement>& after, const FigureRule& rule) {
  const auto value_of = [](const Judgement& one) { return one.measurement.value; };
  const Numbers was = numbers_of(before, value_of), is = numbers_of(after, value_of);
  if (was.empty() || is.empty()) return std::nullopt;
  using Change = FiguresCompared::Change;
  FiguresCompared result{.change = Change::same, .text = arrow(was, is)};
  const checks::Criterion& first = before.front().criterion;
  const checks::Criterion& last = after.front().criterion;
  if (!last.unit.empty()) result.text += " " + last.unit;
  const std::string limit = to_text(first), new_limit = to_text(last);
  if (!new_limit.empty())
    result.text += ", limit " + (limit == new_limit ? limit : limit + " -> " + new_limit);
  const Numbers margin_was = numbers_of(before, checks::margin),
                margin_is = numbers_of(after, checks::margin);
  const bool scatters = !rule.repeatable;
  const bool several = before.size() + after.size() > 2;
  const bool changed = !equal(mean_of(was), mean_of(is));
  if (margin_was.empty() || margin_is.empty()) {
    if (changed) result.change = Change::changed;
    return result;
  }
  result.text += fmt::format(", margin {} -> {}", percent(margin_was), percent(margin_is));
  const double loss = mean_of(margin_was) - mean_of(margin_is);
  bool significant = changed, counts = rule.repeatable;
  if (several) {
    // Without any scatter the test is sure of the smallest difference, so the tolerance decides.
    const RunTest smaller = run_test(margin_is, margin_was, 0), larger = run_test(margin_was, margin_is, 0);
    const double p = std::min(smaller.p, larger.p);
    significant = changed && p < rule.largest_p;
    counts = smaller.p < rule.largest_p;
    if (changed && scatters) result.text += fmt::format(" (p {:.2g})", p);
  }
  if (significant) result.change = Change::changed;
  if (counts && loss > rule.tolerance) result.change = Change::worse;
  return result;
}

}  // namespace canhil::report
