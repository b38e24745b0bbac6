// Flies a suite against a target and decides for each requirement whether it is met.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/accept/suite.hpp"
#include "bench/checks/verdict.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::accept {

/// One test for a requirement.
struct Item {
  std::string requirement;  ///< id of the requirement
  std::string name;         ///< "flight 'paper': error attitude.heading"
  checks::Outcome outcome = checks::Outcome::not_measured;
  std::string measured;
  std::string expected;
};

struct Options {
  std::string target;                   ///< program
  std::optional<std::uint64_t> seed{};  ///< replaces the campaigns' own seeds
  double share = 1;                     ///< factor for the tolerances of the references
  bool first_failure = false;           ///< stops at the first failure
  std::vector<std::string> families{};  ///< only requirements of these families; empty: all
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// A requirement with its results.
struct Finding {
  Requirement requirement;
  std::vector<Item> items;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// The result of one suite.
struct Acceptance {
  std::string estimator;
  std::string title;
  std::vector<Finding> findings;  ///< in the order of the suite
  double wall_s = 0;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// Error: the suite cannot be flown (usage or configuration). A failing target is no Error: the findings
/// report it.
Result<Acceptance> accept(const Suite& suite, const Options& options, const std::atomic<bool>& stop);

/// Flies the suite's flights in this process, with rounded and unrounded frames, and writes their references.
/// Error: one line.
Result<void> record(const Suite& suite, const std::atomic<bool>& stop,
                    const std::function<void(const std::string&)>& progress);

}  // namespace canhil::accept
