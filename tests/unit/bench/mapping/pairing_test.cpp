// Which causes of answers are certain. A slow judge tries every assignment.
#include "bench/mapping/pairing.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>
#include <vector>

namespace canhil::mapping {
namespace {

struct Event {
  bool stimulus = false;
  std::uint64_t echoed = 0;
  std::int64_t t_ns = 0;
};

std::vector<Paired> paired_by(const std::vector<Event>& events) {
  std::vector<Paired> all;
  const Pairing::Give give = [&](const Paired& one) { all.push_back(one); };
  Pairing pairing;
  std::int64_t stimuli = 0;
  for (const Event& event : events) {
    if (event.stimulus)
      pairing.sent(event.echoed, stimuli++, event.t_ns, give);
    else
      pairing.answered({.frame = {}, .t_ns = event.t_ns}, event.echoed, {.certain = false}, give);
  }
  pairing.end(give);
  return all;
}

// For each answer, the stimuli that it has in some assignment: the causes rise, fit and are older than their
// answers. The events must have such an assignment.
std::vector<std::set<std::int64_t>> possible_causes(const std::vector<Event>& events) {
  std::vector<Event> stimuli, answers;
  for (const Event& event : events) (event.stimulus ? stimuli : answers).push_back(event);
  std::vector<std::set<std::int64_t>> possible(answers.size());
  std::vector<std::size_t> causes;
  const std::function<void(std::size_t)> assign = [&](std::size_t from) {
    if (causes.size() == answers.size()) {
      for (std::size_t i = 0; i < causes.size(); ++i)
        possible[i].insert(static_cast<std::int64_t>(causes[i]));
      return;
    }
    const Event& answer = answers[causes.size()];
    for (std::size_t k = from; k < stimuli.size() && stimuli[k].t_ns <= answer.t_ns; ++k) {
      if (stimuli[k].echoed != answer.echoed) continue;
      causes.push_back(k);
      assign(k + 1);
      causes.pop_back();
    }
  };
  assign(0);
  return possible;
}

// A target that answers some stimuli, each after a wait that may be longer than several periods.
std::vector<Event> random_events(std::mt19937& random, std::uint64_t modulus) {
  const auto below = [&](int most) { return std::uniform_int_distribution<int>(0, most - 1)(random); };
  std::vector<Event> events;
  std::int64_t answer_ns = 0;
  for (int k = 0; k < 9; ++k) {
    const std::int64_t t_ns = 10 * k;
    const std::uint64_t echoed = static_cast<std::uint64_t>(k) % modulus;
    events.push_back({.stimulus = true, .echoed = echoed, .t_ns = t_ns});
    if (below(4) == 0) continue;
    answer_ns = std::max<std::int64_t>(answer_ns, t_ns + (below(2) == 0 ? 1 : below(50))) + 1;
    events.push_back({.echoed = echoed, .t_ns = answer_ns});
  }
  // A stimulus that is sent at the time of an answer comes before this answer.
  std::ranges::stable_sort(events, {}, [](const Event& one) { return std::pair(one.t_ns, !one.stimulus); });
  return events;
}

TEST(Pairing, IsCertainIfEveryAssignmentAgrees) {
  std::mt19937 random(7);
  std::size_t certain = 0, uncertain = 0;
  for (int run = 0; run < 2000; ++run) {
    const std::vector<Event> events = random_events(random, 1 + static_cast<std::uint64_t>(run) % 4);
    const auto possible = possible_causes(events);
    const auto paired = paired_by(events);
    ASSERT_EQ(paired.size(), possible.size());
    for (std::size_t i = 0; i < paired.size(); ++i) {
      ASSERT_EQ(paired[i].certain, possible[i].size() == 1) << "run " << run << ", answer " << i;
      ASSERT_EQ(paired[i].cause_us, *possible[i].rbegin()) << "run " << run << ", answer " << i;
      ++(paired[i].certain ? certain : uncertain);
    }
  }
  EXPECT_GT(certain, 1000U);
  EXPECT_GT(uncertain, 1000U);
}

// The counter of a target that is late by a whole round: every answer fits the stimulus just before it.
TEST(Pairing, ARoundLateIsNotOnTime) {
  for (const int late : {0, 16}) {
    std::vector<Event> events;
    for (int k = 0; k < 600; ++k) {
      events.push_back({.stimulus = true, .echoed = static_cast<std::uint64_t>(k % 16), .t_ns = 10 * k});
      if (k >= late) events.push_back({.echoed = static_cast<std::uint64_t>(k % 16), .t_ns = 10 * k + 1});
    }
    const auto paired = paired_by(events);
    ASSERT_EQ(paired.size(), static_cast<std::size_t>(600 - late));
    for (const Paired& one : paired) {
      EXPECT_EQ(one.certain, late == 0);
      EXPECT_EQ(one.apart_us, late);
    }
  }
}

// After a restart, the target cannot answer what it did not get.
TEST(Pairing, ARestartEndsTheDoubt) {
  std::vector<Paired> all;
  const Pairing::Give give = [&](const Paired& one) { all.push_back(one); };
  Pairing pairing;
  for (int k = 0; k < 5; ++k) pairing.sent(0, k, k, give);
  pairing.end(give);
  pairing.sent(0, 5, 5, give);
  pairing.answered({.frame = {}, .t_ns = 6}, 0, {.certain = false}, give);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(all[0].certain);
  EXPECT_EQ(all[0].cause_us, 5);
}

}  // namespace
}  // namespace canhil::mapping
