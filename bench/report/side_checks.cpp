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
#include "bench/checks/verdict.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using Reports = std::vector<Json>;
using checks::Outcome;

// The result of a check in a run.
enum Says : std::uint8_t { pass, fail, not_measured, not_there };
constexpr std::array<std::string_view, 4> said{checks::name(Outcome::pass), checks::name(Outcome::fail),
                                               checks::name(Outcome::not_measured), "not there"};

Says outcome_of(const std::string& name, const std::string& of) {
  for (const Says one : {pass, fail, not_measured}) {
    if (said[one] == name) return one;
  }
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
    all.judged.emplace(key, Judged{outcome, check.at("measured").get<std::string>()});
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

}  // namespace

ChecksCompared compare_checks(const Reports& before, const Reports& after, bool lockstep) {
  const auto first = judged_in_all(before), second = judged_in_all(after);
  std::vector<Key> keys;
  std::set<Key> known;
  for (const auto* side : {&second, &first}) {
    for (const Checks& run : *side) {
      for (const Key& key : run.in_order) {
        if (known.insert(key).second) keys.push_back(key);
      }
    }
  }
  ChecksCompared result;
  for (const Key& key : keys) {
    const Tally was = tally_of(first, key), is = tally_of(second, key);
    const auto together = [&](Says what) { return was.saying[what] + is.saying[what]; };
    const bool never_judged = together(not_measured) == was.runs() + is.runs() && lockstep;
    const bool worse = got_worse(was, is);
    const bool unknown = together(not_there) > 0 || (together(not_measured) > 0 && !never_judged);
    result.worse = result.worse || worse;
    result.unknown = result.unknown || unknown;
    const std::string from = was.text(), to = is.text();
    if (from == to && !unknown) continue;
    const std::string_view what = worse ? "worse" : unknown ? "unknown" : "changed";
    result.text += one_line(fmt::format("{:<8} check '{}': {} -> {}{}", what, key.name, from, to,
                                        is.measured.empty() ? "" : fmt::format(" ({})", is.measured))) +
                   "\n";
  }
  const Tally was = verdicts(before), is = verdicts(after);
  if (!result.worse && got_worse(was, is)) {
    result.worse = true;
    result.text += fmt::format("worse    the run: {}\n", one_line(is.measured));
  }
  return result;
}

}  // namespace canhil::report
