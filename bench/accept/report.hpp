// What became of an acceptance, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"

namespace canhil::accept {

/// Of one `hil-bench accept`.
struct Report {
  std::string target;  ///< as it was named
  std::int64_t started_s = 0;
  std::vector<Acceptance> suites;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// A line a requirement, and below it what failed or was not measured.
std::string text(const Report& report);
std::string json(const Report& report);
/// A test suite an estimator, a case a thing that was looked at.
std::string junit(const Report& report);
/// One page that needs nothing outside itself.
std::string page(const Report& report);

}  // namespace canhil::accept
