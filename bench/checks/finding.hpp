// The result of a check, and functions that all kinds of checks use.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/verdict.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

struct Finding {
  Outcome outcome = Outcome::not_measured;
  std::string measured;
  std::string expected;
};

constexpr Outcome pass_if(bool good) { return good ? Outcome::pass : Outcome::fail; }

constexpr bool within(const scenario::Window& window, std::int64_t t_us) {
  return t_us >= window.from_us && t_us <= window.to_us;
}

/// "from 1 to 2 s".
std::string seconds(const scenario::Window& window);

}  // namespace canhil::checks
