#include "bench/conformance/rules.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>

#include "bench/conformance/groups.hpp"

namespace canhil::conformance {

using namespace messages;

std::vector<Rule> rules(bool parameters_known, bool apply_known) {
  std::vector<Rule> all;
  for (const auto& some : {handshake_rules(), flight_rules(), fault_rules(), parameter_rules()}) {
    for (const Rule& rule : some) {
      const bool known = rule.needs == Needs::nothing ||
                         (rule.needs == Needs::parameters && parameters_known) ||
                         (rule.needs == Needs::apply && apply_known);
      if (known) all.push_back(rule);
    }
  }
  return all;
}

std::string described(const std::optional<TargetHeartbeat>& beat) {
  if (!beat) return "no heartbeat";
  return fmt::format("state {}, {} {}, errors: {}", name_of(beat->state), name_of(beat->estimator),
                     name_of(beat->algorithm), protocol::errors_of(*beat));
}

std::string made_to_run(Subject& subject) {
  if (auto wrong = subject.talk.make_ready(); !wrong.empty()) return wrong;
  return subject.talk.start();
}

std::string flies(Subject& subject) {
  if (auto wrong = made_to_run(subject); !wrong.empty()) return wrong;
  return subject.talk.fly(some_flight_us) > 0 ? "" : "no answers after the start";
}

Result<const Undisturbed*> undisturbed(Subject& subject) {
  if (subject.undisturbed) return &*subject.undisturbed;
  if (auto wrong = made_to_run(subject); !wrong.empty()) return failure(wrong);
  subject.talk.fly(flight_us);
  Undisturbed flown{.heard = subject.talk.heard(), .sample = {}};
  const auto samples = groups_in(subject.talk.flown());
  std::map<std::string_view, std::set<double>> times_of;  // for each group, the times of its answered samples
  for (const Group& answer : groups_in(flown.heard)) {
    const auto cause = answer.value("cause_time_us");
    for (const Group& sample : samples) {
      if (cause && answers(answer.name, sample.name) && sample.value("time_of_validity_us") == cause)
        times_of[sample.name].insert(*cause);
    }
  }
  constexpr std::size_t least = 10;
  const auto most = std::ranges::max_element(times_of, {}, [](const auto& one) { return one.second.size(); });
  if (most == times_of.end() || most->second.size() < least)
    return failure(fmt::format("{:g} s of flight without faults: not {} samples are answered with their time",
                               1e-6 * static_cast<double>(flight_us), least));
  flown.sample = most->first;
  flown.time_us = *std::next(most->second.begin(), static_cast<std::ptrdiff_t>(most->second.size() / 2));
  for (const Group& sample : samples) {
    if (sample.name != flown.sample) continue;
    if (sample.value("time_of_validity_us") == flown.time_us) break;
    ++flown.index;
  }
  return &subject.undisturbed.emplace(std::move(flown));
}

}  // namespace canhil::conformance
