// Flies the flights of a suite against a target and judges for each requirement whether it is met.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/accept/suite.hpp"
#include "bench/checks/verdict.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::accept {

/// The result of one test for a requirement: `name` is, for example, "flight 'paper': error
/// attitude.heading", `kind` the kind of check or metric, or what else was tested.
using Item = checks::CheckResult;

struct Options {
  std::string target;                   ///< the target's command: program and arguments
  std::optional<std::uint64_t> seed{};  ///< replaces the seeds in the campaign files
  bool same_as_hil_target = false;      ///< also compare the answers with those of hil-target's code
  double share = 1;                     ///< factor by which the tolerances of this comparison are multiplied
  unsigned threads = 0;        ///< number of flights at the same time, but for real time; 0: one per core
  bool first_failure = false;  ///< stop at the first failure
  std::vector<std::string> families{};  ///< test only requirements of these families; empty: all
  std::function<void()> begun = [] {};  ///< called when the target has been found
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// A requirement with its results.
struct Finding {
  Requirement requirement;
  std::vector<Item> items;
  bool reached = true;  ///< false: the first failure ended the suite before all tests of the requirement
  [[nodiscard]] checks::Outcome outcome() const;
};
/// The outcome of a requirement in words: "pass", "fail", "not measured" or "not reached".
std::string_view word(const Finding& finding);

/// The result of one suite.
struct Acceptance {
  std::string estimator;
  std::string title;
  std::vector<Finding> findings;  ///< in the order of the suite's requirements
  double wall_s = 0;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// Returns an Error if the suite cannot be flown because of wrong usage or configuration. A target that fails
/// requirements does not cause an Error: the findings report the failures.
Result<Acceptance> accept(const Suite& suite, const Options& options, const std::atomic<bool>& stop);

}  // namespace canhil::accept
