// The result of a check, and functions that all kinds of checks use.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/criterion.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

/// What a check expects, as a sentence and in numbers.
struct Expected {
  std::string text{};
  Criterion criterion{};
};

struct Finding {
  Outcome outcome = Outcome::not_measured;
  std::string measured;
  Expected expected;
  Measurement measurement{};
};

/// The result of a check with this finding.
CheckResult result_of(std::string name, std::string_view kind, std::string requirement, Finding finding);

/// If a check limits several values, its numbers are those of the value that is nearest to its limit, or the
/// furthest beyond it. A value without a margin counts only if it is beyond its limit or if there is no
/// other.
void take_nearest_to_limit(Finding& finding, std::vector<Judgement> judgements);

constexpr Outcome pass_if(bool good) { return good ? Outcome::pass : Outcome::fail; }

constexpr bool within(const scenario::Window& window, std::int64_t t_us) {
  return t_us >= window.from_us && t_us <= window.to_us;
}

/// "from 1 to 2 s".
std::string seconds(const scenario::Window& window);

}  // namespace canhil::checks
