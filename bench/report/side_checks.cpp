#include "bench/report/side_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string_view>

#include "bench/checks/judge.hpp"
#include "bench/checks/result_json.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/report/figures.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using Reports = std::vector<Json>;
using checks::Outcome;

// The result of a check in a run: an outcome, in the order of checks::Outcome, or none.
enum Says : std::uint8_t { pass, fail, not_measured, not_there };
constexpr std::array<std::string_view, 4> said{checks::name(Outcome::pass), checks::name(Outcome::fail),
                                               checks::name(Outcome::not_measured), "not there"};

Says outcome_of(const std::string& name, const std::string& of) {
  if (const auto outcome = checks::outcome_named(name)) return static_cast<Says>(*outcome);
  throw UnknownOutcome{
      fmt::format("outcome '{}' of {}, expected 'pass', 'fail' or 'not measured'", name, of)};
}

// One check in one run. Checks with equal name and kind are distinguished by their order.
struct Key {
  std::string name, kind;
  std::size_t nth = 0;
  auto operator<=>(const Key&) const = default;
};
struct Judged {
  Says outcome = pass;
  std::string measured;
  checks::Judgement numbers;
};
struct Checks {
  std::map<Key, Judged> judged;
  std::vector<Key> in_order;
};

Checks judged_in(const Json& report) {
  Checks all;
  std::map<Key, std::size_t> seen;  // by name and kind
  for (const Json& check : report.at("checks")) {
    Key key{check.at("name").get<std::string>(), check.at("kind").get<std::string>()};
    key.nth = seen[key]++;
    const Says outcome =
        outcome_of(check.at("outcome").get<std::string>(), fmt::format("check '{}'", key.name));
    all.judged.emplace(key,
                       Judged{outcome, check.at("measured").get<std::string>(), checks::judgement_of(check)});
    all.in_order.push_back(std::move(key));
  }
  return all;
}

// The results of one check in the runs of a side.
struct Tally {
  std::array<std::size_t, said.size()> saying{};  // number of runs for each result, by Says
  std::string measured;  // of the first run in which the check failed; if none, of the last run
  [[nodiscard]] std::size_t runs() const {
    return std::accumulate(saying.begin(), saying.end(), std::size_t{0});
  }
  [[nodiscard]] std::string text() const {
    std::string parts;
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (saying[i] == runs()) return std::string(said[i]);
      if (saying[i] > 0) parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", saying[i], said[i]);
    }
    return parts;
  }
};

Tally tally_of(const std::vector<Checks>& side, const Key& key) {
  // The report of a run contains an implied check only if the check did not pass.
  const bool implied = key.name == key.kind && checks::is_implied(key.kind);
  Tally tally;
  for (const auto& run : side) {
    const auto found = run.judged.find(key);
    if (found == run.judged.end()) {
      ++tally.saying[implied ? pass : not_there];
      continue;
    }
    if (tally.saying[fail] == 0) tally.measured = found->second.measured;
    ++tally.saying[found->second.outcome];
  }
  return tally;
}

// The numbers of a check in the runs that judged it.
std::vector<checks::Judgement> numbers_of(const std::vector<Checks>& side, const Key& key) {
  std::vector<checks::Judgement> numbers;
  for (const Checks& run : side) {
    const auto found = run.judged.find(key);
    if (found == run.judged.end() || !found->second.numbers.measurement.value) continue;
    if (found->second.outcome != not_measured) numbers.push_back(found->second.numbers);
  }
  return numbers;
}

bool got_worse(const Tally& before, const Tally& after) {
  const auto mostly = [](const Tally& tally) { return 2 * tally.saying[fail] > tally.runs(); };
  return (before.saying[fail] == 0 && after.saying[fail] > 0) || (mostly(after) && !mostly(before));
}

std::vector<Checks> judged_in_all(const Reports& side) {
  std::vector<Checks> all;
  for (const Json& report : side) all.push_back(judged_in(report));
  return all;
}

Tally verdicts(const Reports& side) {
  Tally tally;
  for (const Json& report : side) {
    if (tally.saying[fail] == 0) tally.measured = report.at("reason").get<std::string>();
    ++tally.saying[outcome_of(report.at("verdict").get<std::string>(), "a run")];
  }
  return tally;
}

// The checks of all runs, in the order of the runs that are judged.
std::vector<Key> keys_of(const std::vector<Checks>& before, const std::vector<Checks>& after) {
  std::vector<Key> keys;
  std::set<Key> known;
  for (const auto* side : {&after, &before}) {
    for (const Checks& run : *side) {
      for (const Key& key : run.in_order) {
        if (known.insert(key).second) keys.push_back(key);
      }
    }
  }
  return keys;
}

}  // namespace

ChecksCompared compare_checks(const Reports& before, const Reports& after, const CheckRule& rule) {
  const auto first = judged_in_all(before), second = judged_in_all(after);
  const std::vector<Key> keys = keys_of(first, second);
  const auto with_numbers = std::ranges::count_if(keys, [&](const Key& key) {
    return !numbers_of(first, key).empty() && !numbers_of(second, key).empty();
  });
  const FigureRule figure_rule{
      .tolerance = rule.tolerance,
      .largest_p = rule.largest_p / static_cast<double>(std::max<std::ptrdiff_t>(with_numbers, 1)),
      .repeatable = rule.repeatable};
  ChecksCompared result;
  if (with_numbers > 0 && !rule.repeatable && before.size() + after.size() == 2)
    result.text = "checks   one run a side: no margin counts as worse, because runs differ\n";
  for (const Key& key : keys) {
    const Tally was = tally_of(first, key), is = tally_of(second, key);
    const auto together = [&](Says what) { return was.saying[what] + is.saying[what]; };
    const bool never_judged = together(not_measured) == was.runs() + is.runs() && rule.lockstep;
    const auto figures = compare_figures(numbers_of(first, key), numbers_of(second, key), figure_rule);
    using Change = FiguresCompared::Change;
    const bool worse = got_worse(was, is) || (figures && figures->change == Change::worse);
    const bool unknown = together(not_there) > 0 || (together(not_measured) > 0 && !never_judged);
    result.worse = result.worse || worse;
    result.unknown = result.unknown || unknown;
    const std::string from = was.text(), to = is.text();
    const bool told = from != to || unknown;  // by its outcomes
    if (!told && !figures) continue;
    const bool changed = from != to || (figures && figures->change == Change::changed);
    const std::string_view what = worse ? "worse" : unknown ? "unknown" : changed ? "changed" : "same";
    std::string line = fmt::format("{:<8} check '{}': {}", what, key.name, from);
    if (told) line += " -> " + to;
    if (told && !is.measured.empty()) line += fmt::format(" ({})", is.measured);
    if (figures) line += "; " + figures->text;
    result.text += one_line(line) + "\n";
  }
  const Tally was = verdicts(before), is = verdicts(after);
  if (!result.worse && got_worse(was, is)) {
    result.worse = true;
    result.text += fmt::format("worse    the run: {}\n", one_line(is.measured));
  }
  return result;
}

}  // namespace canhil::report
