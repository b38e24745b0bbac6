#include "bench/report/side_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/checks/other_senders.hpp"
#include "bench/checks/verdict.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using Reports = std::vector<Json>;
using checks::Outcome;

Outcome outcome_of(const std::string& name, const std::string& of) {
  for (const Outcome outcome : {Outcome::pass, Outcome::fail, Outcome::not_measured}) {
    if (checks::name(outcome) == name) return outcome;
  }
  throw UnknownOutcome{
      fmt::format("outcome '{}' of {}, expected 'pass', 'fail' or 'not measured'", name, of)};
}

// One check in one run. Several checks of a scenario may have one name and kind: they are told apart by their
// order.
struct Key {
  std::string name, kind;
  std::size_t nth = 0;
  bool operator==(const Key&) const = default;
};
struct Judged {
  Key key;
  Outcome outcome = Outcome::pass;
  std::string measured;
};

std::vector<Judged> judged_in(const Json& report) {
  std::vector<Judged> all;
  for (const Json& check : report.at("checks")) {
    Key key{check.at("name").get<std::string>(), check.at("kind").get<std::string>()};
    key.nth = static_cast<std::size_t>(std::ranges::count_if(
        all, [&](const Judged& j) { return j.key.name == key.name && j.key.kind == key.kind; }));
    const Outcome outcome =
        outcome_of(check.at("outcome").get<std::string>(), fmt::format("check '{}'", key.name));
    all.push_back({std::move(key), outcome, check.at("measured").get<std::string>()});
  }
  return all;
}

// What the runs of a side say of one check.
struct Tally {
  std::size_t passed = 0, failed = 0, not_measured = 0, missing = 0;
  std::string measured;  // by the first run that failed it, else by the last
  [[nodiscard]] std::size_t runs() const { return passed + failed + not_measured + missing; }
  [[nodiscard]] bool all_the_same() const {
    return std::max({passed, failed, not_measured, missing}) == runs();
  }
  [[nodiscard]] std::string text() const {
    if (all_the_same())
      return passed > 0 ? "pass" : failed > 0 ? "fail" : missing > 0 ? "not there" : "not measured";
    std::string parts;
    const auto add = [&parts](std::size_t count, std::string_view name) {
      if (count > 0) parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, name);
    };
    add(passed, "pass");
    add(failed, "fail");
    add(not_measured, "not measured");
    add(missing, "not there");
    return parts;
  }
  void add(Outcome outcome) {
    ++(outcome == Outcome::pass ? passed : outcome == Outcome::fail ? failed : not_measured);
  }
};

Tally tally_of(const std::vector<std::vector<Judged>>& side, const Key& key) {
  // The bus and who sends on it are judged unasked too; their checks are there when they do not pass.
  const bool implied =
      key.name == key.kind && (key.kind == checks::BusErrorLimits::kind || key.kind == checks::senders_kind);
  Tally tally;
  for (const auto& run : side) {
    const auto found = std::ranges::find(run, key, &Judged::key);
    if (found == run.end()) {
      ++(implied ? tally.passed : tally.missing);
      continue;
    }
    if (tally.failed == 0) tally.measured = found->measured;
    tally.add(found->outcome);
  }
  return tally;
}

bool got_worse(const Tally& before, const Tally& after) {
  const auto mostly = [](const Tally& tally) { return 2 * tally.failed > tally.runs(); };
  return (before.failed == 0 && after.failed > 0) || (mostly(after) && !mostly(before));
}

std::vector<std::vector<Judged>> judged_in_all(const Reports& side) {
  std::vector<std::vector<Judged>> all;
  for (const Json& report : side) all.push_back(judged_in(report));
  return all;
}

Tally verdicts(const Reports& side) {
  Tally tally;
  for (const Json& report : side) {
    if (tally.failed == 0) tally.measured = report.at("reason").get<std::string>();
    tally.add(outcome_of(report.at("verdict").get<std::string>(), "a run"));
  }
  return tally;
}

}  // namespace

ChecksCompared compare_checks(const Reports& before, const Reports& after, bool virtual_time) {
  const auto first = judged_in_all(before), second = judged_in_all(after);
  std::vector<Key> keys;
  for (const auto* side : {&second, &first}) {
    for (const auto& run : *side) {
      for (const Judged& judged : run) {
        if (std::ranges::find(keys, judged.key) == keys.end()) keys.push_back(judged.key);
      }
    }
  }
  ChecksCompared result;
  for (const Key& key : keys) {
    const Tally was = tally_of(first, key), is = tally_of(second, key);
    const bool never_judged = was.not_measured == was.runs() && is.not_measured == is.runs() && virtual_time;
    const bool worse = got_worse(was, is);
    const bool unknown =
        was.missing + is.missing > 0 || (was.not_measured + is.not_measured > 0 && !never_judged);
    result.worse = result.worse || worse;
    result.unknown = result.unknown || unknown;
    const std::string from = was.text(), to = is.text();
    if (from == to && !unknown) continue;
    result.text +=
        fmt::format("{:<8} check '{}': {} -> {}{}\n",
                    worse     ? "worse"
                    : unknown ? "unknown"
                              : "changed",
                    key.name, from, to, is.measured.empty() ? "" : fmt::format(" ({})", is.measured));
  }
  const Tally was = verdicts(before), is = verdicts(after);
  if (!result.worse && got_worse(was, is)) {
    result.worse = true;
    result.text += fmt::format("worse    the run: {}\n", is.measured);
  }
  return result;
}

}  // namespace canhil::report
