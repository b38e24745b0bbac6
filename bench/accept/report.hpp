// Reports of an acceptance test for people and programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"

namespace canhil::accept {

/// The report of one `hil-bench accept`.
struct Report {
  std::string target;  ///< as given by the user
  std::int64_t started_s = 0;
  std::vector<Acceptance> suites;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// One line for each requirement, followed by what failed or was not measured.
std::string text(const Report& report);
std::string json(const Report& report);
/// One test suite for each estimator, one test case for each test.
std::string junit(const Report& report);
/// A self-contained page.
std::string page(const Report& report);

}  // namespace canhil::accept
