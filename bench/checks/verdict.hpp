// The verdict of a run and the results of its checks.
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/criterion.hpp"

namespace canhil::checks {

enum class Outcome : std::uint8_t { pass, fail, not_measured };

constexpr std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::pass:
      return "pass";
    case Outcome::fail:
      return "fail";
    case Outcome::not_measured:
      return "not measured";
  }
  return "?";
}

/// Combines outcomes: fail if any failed; otherwise not measured if any was not measured or if there are no
/// outcomes; otherwise pass.
template <class Parts, class Projection>
constexpr Outcome outcome_of(const Parts& parts, Projection projection) {
  Outcome all = std::begin(parts) == std::end(parts) ? Outcome::not_measured : Outcome::pass;
  for (const auto& part : parts) {
    const Outcome one = std::invoke(projection, part);
    if (one == Outcome::fail) return Outcome::fail;
    if (one == Outcome::not_measured) all = Outcome::not_measured;
  }
  return all;
}

/// The result of one check.
struct CheckResult {
  std::string name;
  std::string kind;
  std::string requirement;  ///< id of the requirement that the check verifies; may be empty
  Outcome outcome = Outcome::not_measured;
  std::string measured;  ///< the measured value with its unit, or why the check was not measured
  std::string expected;
  Judgement judgement{};  ///< the same in numbers, where the kind has them
};

/// The verdict of a whole run: fail if a check failed; otherwise not measured if a check was not measured;
/// otherwise pass.
struct Verdict {
  Outcome outcome = Outcome::not_measured;
  std::string reason;  ///< one line
  std::vector<CheckResult> checks;
};

/// Sets outcome and reason from the checks; `ended_early`: why the run ended early; empty: the run was
/// completed.
void conclude(Verdict& verdict, const std::string& ended_early);

}  // namespace canhil::checks
