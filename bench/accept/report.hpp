// Formats the report of an acceptance test: as text and HTML for people, as JSON and JUnit XML for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"
#include "bench/drive/run_files.hpp"

namespace canhil::accept {

/// The report of one `hil-bench accept`.
struct Report {
  std::string target;                   ///< the target's command as given by the user
  std::string same_as{};                ///< with what the answers were compared; empty: with nothing
  double tolerance = 1;                 ///< factor of the tolerances of this comparison
  std::vector<std::string> families{};  ///< those that were asked for; empty: all
  std::optional<std::uint64_t> seed{};  ///< of the campaigns; none: their own
  std::vector<drive::RunFile> files{};  ///< the programs of bench and target, and the files of the suites
  std::int64_t started_s = 0;
  std::vector<Acceptance> suites;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// One line for each requirement, followed by its items that failed or were not measured.
std::string text(const Report& report);
std::string json(const Report& report);
/// JUnit XML: one test suite for each estimator, one test case for each item.
std::string junit(const Report& report);
/// A self-contained HTML page.
std::string page(const Report& report);

}  // namespace canhil::accept
