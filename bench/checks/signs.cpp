#include "bench/checks/signs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::checks {
namespace {

constexpr std::string_view every_answer = "answers";

bool is_plain(const estimators::Estimator& estimator, std::string_view mark) {
  return mark == every_answer ||
         std::ranges::find(estimator.plain_marks, mark) != estimator.plain_marks.end();
}

void add(std::vector<Sign>& signs, const std::vector<Complaints::Said>& said, std::string_view by) {
  for (const Complaints::Said& one : said) {
    auto sign = std::ranges::find_if(
        signs, [&](const Sign& other) { return other.name == one.what && other.by == by; });
    if (sign == signs.end()) sign = signs.insert(signs.end(), {.name = one.what, .by = by});
    sign->t_us.push_back(one.t_us);
  }
}

}  // namespace

std::string Sign::to_text() const { return fmt::format("{} in {}", name, by); }

std::vector<Sign> signs_in(const Observations& seen,
                           std::span<const estimators::Estimator* const> estimators) {
  std::vector<Sign> signs;
  for (const estimators::Estimator* one : estimators) {
    for (const estimators::Mark& mark : one->marks(seen)) {
      if (is_plain(*one, mark.name) || mark.t_us.empty()) continue;
      signs.push_back({.name = mark.name, .by = "an answer"});
      for (const std::int64_t t_us : mark.t_us) signs.back().t_us.push_back(t_us);
    }
  }
  add(signs, seen.complaints.of_heartbeats(), "a heartbeat");
  add(signs, seen.complaints.of_counters(), "a counter");
  return signs;
}

std::vector<std::string> sign_names(std::span<const estimators::Estimator* const> estimators) {
  std::vector<std::string> names;
  const auto name = [&](std::string_view one) {
    if (std::ranges::find(names, one) == names.end()) names.emplace_back(one);
  };
  for (const estimators::Estimator* one : estimators) {
    for (const estimators::Mark& mark : one->marks(Observations{})) {
      if (!is_plain(*one, mark.name)) name(mark.name);
    }
  }
  for (const std::string_view word : Complaints::names()) name(word);
  return names;
}

bool was_there_before(const Sign& sign, std::int64_t onset_us) {
  const auto at = std::ranges::lower_bound(sign.t_us, onset_us - just_before_us);
  return at != sign.t_us.end() && *at < onset_us;
}

std::vector<Sign> new_since(std::vector<Sign> signs, std::int64_t onset_us) {
  std::erase_if(signs, [&](const Sign& sign) { return was_there_before(sign, onset_us); });
  return signs;
}

bool can_show_signs(const Observations& seen, std::span<const estimators::Estimator* const> estimators) {
  const bool heartbeat = std::ranges::find(seen.timing.messages, messages::TargetHeartbeat::info.name,
                                           &MessageInfo::name) != seen.timing.messages.end();
  return heartbeat || std::ranges::any_of(estimators, [&](const estimators::Estimator* one) {
           return std::ranges::any_of(
               one->marks(seen), [&](const estimators::Mark& mark) { return !is_plain(*one, mark.name); });
         });
}

std::optional<SignAt> first_in(std::span<const Sign> signs, std::int64_t from_us, std::int64_t to_us) {
  std::optional<SignAt> first;
  for (const Sign& sign : signs) {
    const auto at = std::ranges::lower_bound(sign.t_us, from_us);
    if (at == sign.t_us.end() || *at > to_us || (first && first->t_us <= *at)) continue;
    first = SignAt{.t_us = *at, .text = sign.to_text()};
  }
  return first;
}

std::optional<SignAt> last_after(std::span<const Sign> signs, std::int64_t t_us) {
  std::optional<SignAt> last;
  for (const Sign& sign : signs) {
    if (sign.t_us.empty() || sign.t_us.back() <= t_us || (last && last->t_us >= sign.t_us.back())) continue;
    last = SignAt{.t_us = sign.t_us.back(), .text = sign.to_text()};
  }
  return last;
}

}  // namespace canhil::checks
