#include "bench/accept/accept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "bench/accept/ahead.hpp"
#include "bench/accept/campaign.hpp"
#include "bench/accept/dialogue.hpp"
#include "bench/accept/item.hpp"
#include "bench/accept/profile.hpp"
#include "bench/accept/reference.hpp"
#include "bench/accept/response.hpp"
#include "bench/conformance/conformance.hpp"
#include "bench/drive/session.hpp"

namespace canhil::accept {
namespace {

using checks::Outcome;
using drive::Ending;

// What one flight brought: the results of its own checks, and its answers, for flights that are compared with
// it.
struct Flown {
  Result<std::vector<Item>> items;
  std::unique_ptr<Answers> answers = std::make_unique<Answers>();
};

// The execution of one suite.
class Run {
 public:
  Run(const Suite& suite, const Options& options, const std::atomic<bool>& stop)
      : suite_(suite), options_(options), stop_(stop) {}

  // The fastest tests run first; the flights in real time run last.
  Result<std::vector<Item>> fly() {
    if (auto there = find_target(); !there) return tl::unexpected(there.error());
    options_.begun();
    if (auto flown = fly_all(false); !flown) return tl::unexpected(flown.error());
    if (suite_.dialogue && (wanted("protocol") || wanted("parameters")) && done()) {
      for (const Requirement& requirement : protocol_requirements(suite_)) skipped_.insert(requirement.id);
    } else if (suite_.dialogue && (wanted("protocol") || wanted("parameters"))) {
      options_.progress(fmt::format("{}: dialogue", suite_.estimator));
      auto said = talk(suite_, options_.target, stop_);
      if (!said) return tl::unexpected(said.error());
      for (Item& item : *said) add(std::move(item));
    }
    for (const std::string& campaign : suite_.campaigns) {
      if (!(wanted("errors") || wanted("honesty"))) break;
      if (auto flown = fly_campaign(campaign); !flown) return tl::unexpected(flown.error());
    }
    if (auto flown = fly_all(true); !flown) return tl::unexpected(flown.error());
    return std::move(items_);
  }
  // The requirements of which a test was left out after the first failure.
  [[nodiscard]] const std::set<std::string>& skipped() const { return skipped_; }

 private:
  // A target that cannot be started, or that sends nothing, is found before a hundred flights fail one by
  // one.
  [[nodiscard]] Result<void> find_target() const {
    const scenario::Scenario* first = suite_.dialogue          ? &*suite_.dialogue
                                      : suite_.flights.empty() ? nullptr
                                                               : &suite_.flights.front().scenario;
    return first == nullptr ? Result<void>{} : conformance::find_target(*first, options_.target, stop_);
  }

  /// Flights in lockstep are flown on several threads; flights in real time one after the other, because
  /// others beside them would take their time.
  Result<void> fly_all(bool in_real_time) {
    std::vector<const Flight*> flights;
    for (const Flight& flight : suite_.flights) {
      if (flight.real_time == in_real_time && wanted(flight)) flights.push_back(&flight);
    }
    Ahead<Flight, Flown> ahead(
        done() ? std::vector<const Flight*>() : flights, in_real_time ? 1 : options_.threads,
        [this](const Flight& flight, const std::atomic<bool>& stop) { return fly(flight, stop); }, stop_);
    for (const Flight* flight : flights) {
      if (done()) {
        for (const std::string& id : tested_by(*flight)) skipped_.insert(id);
        continue;
      }
      options_.progress(fmt::format("{}: flight '{}'", suite_.estimator, flight->name));
      Flown flown = ahead.next();
      if (!flown.items) return tl::unexpected(flown.items.error());
      for (Item& one : *flown.items) add(std::move(one));
      for (Item& one : compared(*flight, *flown.answers)) add(std::move(one));
      flown_[flight->name] = std::move(flown.answers);
    }
    return {};
  }

  [[nodiscard]] bool wanted(std::string_view family) const {
    return options_.families.empty() ||
           std::ranges::find(options_.families, family) != options_.families.end();
  }
  /// Whether a selected requirement needs this flight itself, or compares another flight with this flight.
  [[nodiscard]] bool wanted(const Flight& flight) const {
    const auto of = [&](const std::string& id) {
      const Requirement* requirement = suite_.find(id);
      return requirement != nullptr && wanted(requirement->family);
    };
    return std::ranges::any_of(judged_by(flight), of) ||
           std::ranges::any_of(suite_.flights, [&](const Flight& other) {
             return (other.same_as && other.same_as->flight == flight.name && wanted(other)) ||
                    (std::ranges::find(other.moves, flight.name, &Move::flight) != other.moves.end() &&
                     wanted(other));
           });
  }
  [[nodiscard]] bool done() const { return stop_ || (options_.first_failure && failed_); }

  // The requirements that a flight tests itself, apart from those that its checks name.
  [[nodiscard]] std::vector<std::string> judged_by(const Flight& flight) const {
    std::vector<std::string> ids{flight.requirement};
    if (options_.same_as_hil_target && flight.reference) ids.push_back(*flight.reference);
    if (flight.same_as) ids.push_back(flight.same_as->requirement);
    for (const Move& move : flight.moves) ids.push_back(move.requirement);
    return ids;
  }
  // All requirements that a flight tests.
  [[nodiscard]] std::vector<std::string> tested_by(const Flight& flight) const {
    std::vector<std::string> ids = judged_by(flight);
    for (const scenario::Check& check : flight.scenario.checks) ids.push_back(check.requirement);
    return ids;
  }

  using Items = std::vector<Item>;

  void add(Item item) {
    failed_ = failed_ || item.outcome == Outcome::fail;
    items_.push_back(std::move(item));
  }
  /// A flight in real time that does not pass is repeated, up to twice, because the host may cause occasional
  /// delays. Only the results of the last attempt are used.
  Flown fly(const Flight& flight, const std::atomic<bool>& stop) const {
    const auto good = [](const Flown& flown) {
      return !flown.items || checks::outcome_of(*flown.items, &Item::outcome) == Outcome::pass;
    };
    Flown flown = fly_once(flight, stop);
    for (int left = flight.real_time ? 2 : 0; left > 0 && !good(flown) && !stop; --left)
      flown = fly_once(flight, stop);
    return flown;
  }

  Flown fly_once(const Flight& flight, const std::atomic<bool>& stop) const {
    const std::string name = name_of(flight);
    Flown flown{.items = Items()};
    drive::Options options = drive::in_lockstep_against(options_.target);
    options.lockstep = !flight.real_time;
    options.format = drive::format_of(flight.scenario);
    options.onlookers = {flown.answers.get()};
    const auto run = drive::run(flight.scenario, options, stop, [](std::int64_t) {});
    if (!run) {
      flown.items->push_back(item(flight.requirement, name, run.error().message, flown_to_its_end));
      return flown;
    }
    *flown.items = judged(flight, name, *run);
    if (options_.same_as_hil_target && flight.reference && !stop) {
      const auto reference = reference_of(flight, stop);
      if (!reference) return {.items = tl::unexpected(reference.error())};
      flown.items->push_back(item(*flight.reference, name + " as the reference",
                                  departure(*reference, *flown.answers, options_.share),
                                  "answers as the reference's"));
    }
    return flown;
  }

  /// Compares a flight with others, which were flown before.
  [[nodiscard]] Items compared(const Flight& flight, const Answers& answers) const {
    const std::string name = name_of(flight);
    Items found;
    if (flight.same_as) {
      const SameAs& same = *flight.same_as;
      found.push_back(item(same.requirement, fmt::format("{} as flight '{}'", name, same.flight),
                           difference(answers, *flown_.at(same.flight), same.steps, same.relative),
                           "the same answers"));
    }
    for (const Move& move : flight.moves)
      found.push_back(judge_move(move, name, answers, *flown_.at(move.flight)));
    return found;
  }

  static std::string name_of(const Flight& flight) { return fmt::format("flight '{}'", flight.name); }

  // The answers of hil-target's code in this process: with frames as they are, and with unrounded ones.
  static Result<Reference> reference_of(const Flight& flight, const std::atomic<bool>& stop) {
    Answers rounded, unrounded;
    for (const auto& [bus, answers] :
         {std::pair(drive::in_process_bus, &rounded), std::pair(drive::unrounded_bus, &unrounded)}) {
      drive::Options options;
      options.bus = drive::BusName(std::string(bus));
      options.onlookers = {answers};
      const auto run = drive::run(flight.scenario, options, stop, [](std::int64_t) {});
      if (!run) return tl::unexpected(run.error());
      const auto expected = flight.faults ? Ending::Kind::target_fault : Ending::Kind::completed;
      if (run->ending.kind != expected && !stop)
        return failure(fmt::format(
            "flight '{}' of the reference: {}", flight.name,
            run->ending.detail.empty() ? "is flown to its end, expected a fault" : run->ending.detail));
    }
    return make_reference(rounded, unrounded, flight.rows);
  }

  /// Converts the results of the checks and the ending of the flight to items.
  Items judged(const Flight& flight, const std::string& name, const drive::Run& run) const {
    if (flight.faults) {
      const bool fault = run.ending.kind == Ending::Kind::target_fault;
      const std::string ending = run.ending.detail.empty() ? flown_to_its_end : run.ending.detail;
      return {
          item(flight.requirement, name + " ends", fault ? "" : ending, "a heartbeat that reports a fault")};
    }
    if (run.ending.kind == Ending::Kind::interrupted) return {};
    Items found{item(flight.requirement, name + " ends", run.ending.detail, flown_to_its_end)};
    if (run.ending.kind != Ending::Kind::completed) return found;
    for (const checks::CheckResult& check : run.verdict.checks) {
      // A flight in lockstep does not measure the timing, so its timing checks are skipped here. The suite's
      // flights in real time judge the timing. A flight that has no other check measures nothing.
      if (!flight.real_time && check.outcome == Outcome::not_measured && !all_timing(run)) continue;
      Item& judged = found.emplace_back(check);
      judged.name = fmt::format("{}: {}", name, check.name);
      if (suite_.find(check.requirement) == nullptr) judged.requirement = flight.requirement;
    }
    return found;
  }

  static bool all_timing(const drive::Run& run) {
    return std::ranges::all_of(run.verdict.checks, [](const checks::CheckResult& check) {
      return check.outcome == Outcome::not_measured;
    });
  }

  Result<void> fly_campaign(const std::string& name) {
    if (done()) {
      const auto ids = tested_by_campaign(suite_, name);
      if (!ids) return tl::unexpected(ids.error());
      skipped_.insert(ids->begin(), ids->end());
      return {};
    }
    auto found = accept::fly_campaign(suite_, name, options_, stop_);
    if (!found) return tl::unexpected(found.error());
    for (Item& one : *found) add(std::move(one));
    return {};
  }

  static constexpr const char* flown_to_its_end = "a flight to its end";

  const Suite& suite_;
  const Options& options_;
  const std::atomic<bool>& stop_;
  std::map<std::string, std::unique_ptr<Answers>> flown_;
  std::vector<Item> items_;
  std::set<std::string> skipped_;
  bool failed_ = false;
};

}  // namespace

Outcome Finding::outcome() const {
  const Outcome found = checks::outcome_of(items, &Item::outcome);
  return reached || found == Outcome::fail ? found : Outcome::not_measured;
}

std::string_view word(const Finding& finding) {
  const bool cut = !finding.reached && finding.outcome() != Outcome::fail;
  return cut ? "not reached" : checks::name(finding.outcome());
}

Outcome Acceptance::outcome() const { return checks::outcome_of(findings, &Finding::outcome); }

Result<Acceptance> accept(const Suite& suite, const Options& options, const std::atomic<bool>& stop) {
  const auto start = std::chrono::steady_clock::now();
  Run run(suite, options, stop);
  auto items = run.fly();
  if (!items) return tl::unexpected(items.error());
  Acceptance acceptance{.estimator = suite.estimator, .title = suite.title, .findings = {}};
  std::vector<Requirement> all = suite.requirements;
  if (suite.dialogue) std::ranges::copy(protocol_requirements(suite), std::back_inserter(all));
  const auto& asked = options.families;
  std::erase_if(all, [&](const Requirement& one) {
    return !asked.empty() && std::ranges::find(asked, one.family) == asked.end();
  });
  for (Requirement& requirement : all) {
    const bool reached = !run.skipped().contains(requirement.id);
    acceptance.findings.push_back({.requirement = std::move(requirement), .items = {}, .reached = reached});
  }
  for (Item& item : *items) {
    const auto found = std::ranges::find_if(acceptance.findings, [&](const Finding& finding) {
      return finding.requirement.id == item.requirement;
    });
    if (found == acceptance.findings.end() && !asked.empty())
      continue;  // the requirement's family was not selected
    if (found == acceptance.findings.end())
      return failure(fmt::format("{}: {} is for '{}', expected a requirement of the suite",
                                 suite.folder.string(), item.name, item.requirement));
    found->items.push_back(std::move(item));
  }
  if (!options.same_as_hil_target) {  // what only the comparison tests was not asked
    std::erase_if(acceptance.findings, [&](const Finding& finding) {
      return finding.items.empty() && finding.reached &&
             std::ranges::any_of(suite.flights, [&](const Flight& flight) {
               return flight.reference == finding.requirement.id;
             });
    });
  }
  for (Finding& finding : acceptance.findings) {
    if (!finding.items.empty() || !finding.reached) continue;
    finding.items.push_back({.name = "tests",
                             .kind = "accept",
                             .requirement = finding.requirement.id,
                             .outcome = Outcome::not_measured,
                             .measured = "the suite has none",
                             .expected = "a flight, a rule or a metric with this requirement"});
  }
  acceptance.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return acceptance;
}

}  // namespace canhil::accept
