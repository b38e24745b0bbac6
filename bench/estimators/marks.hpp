// Building blocks for an estimator's marks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dbc/spool/spool.hpp"

namespace canhil::estimators {

/// The times of the causes of those answers for which a condition holds.
template <class Answers, class Holds>
Spool<std::int64_t> times_of(const Answers& answers, Holds holds) {
  Spool<std::int64_t> times;
  for (const auto& answer : answers) {
    if (std::invoke(holds, answer)) times.push_back(answer.cause_us);
  }
  return times;
}
inline constexpr auto every_answer = [](const auto&) { return true; };

/// Adds one mark for each value of an enumeration: the times of the answers whose `member` has this value.
template <class Mark, class Enumeration, class Answers, class Values>
void add_marks(std::vector<Mark>& marks, const Answers& answers, Enumeration Answers::value_type::*member,
               const Values& values) {
  for (const Enumeration value : values) {
    marks.push_back({.name = name_of(value),
                     .t_us = times_of(answers, [&](const auto& answer) { return answer.*member == value; })});
  }
}

}  // namespace canhil::estimators
