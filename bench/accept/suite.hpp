// The requirements for accepting a target as an estimator: a folder with suite.toml, the scenarios and
// campaigns that it names, and reference answers (docs/accept.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/conformance/rules.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::accept {

/// A requirement and its family.
struct Requirement {
  std::string id;
  std::string family;  ///< one of `families`
  std::string text;    ///< a sentence
};
inline const std::vector<std::string> families{"errors",           "honesty",  "algorithms", "parameters",
                                               "flags and states", "protocol", "timing"};

/// Another flight of the suite that must have the same answers.
struct SameAs {
  std::string flight;
  std::string requirement;
  double steps = 0;     ///< tolerance in steps of each signal
  double relative = 0;  ///< tolerance relative to the value
};

/// A signal whose mean must be larger, or smaller, in this flight than in another one.
struct Move {
  std::string flight;  ///< the other flight
  std::string message, signal;
  bool up = false;  ///< true: the magnitude of the mean must be larger in this flight
  std::string requirement;
};

/// A flight in lockstep or in real time.
struct Flight {
  std::string name;
  scenario::Scenario scenario{};
  std::string requirement{};  ///< requirement of the checks that name none of the suite
  std::optional<std::string>
      reference{};       ///< requirement: the answers match the reference; none: not compared
  std::size_t rows = 0;  ///< number of instants kept in the reference
  std::optional<SameAs> same_as{};
  std::optional<Move> moves{};
  bool real_time = false;
  bool faults = false;  ///< the target must report a fault
};

using conformance::Parameter;

struct Suite {
  std::filesystem::path folder;
  std::string title;
  std::string estimator;
  std::vector<Requirement> requirements;
  std::vector<Flight> flights;
  std::vector<Parameter> parameters;
  std::vector<std::string> campaigns;  ///< files in the folder
  std::optional<std::pair<std::string, double>>
      apply;                                   ///< a parameter that takes effect in flight; none: not tested
  std::optional<scenario::Scenario> dialogue;  ///< selects the estimator for the dialogue; none: no dialogue

  [[nodiscard]] const Requirement* find(std::string_view id) const;
  [[nodiscard]] std::filesystem::path reference_of(const Flight& flight) const;
};

/// Reads folder/suite.toml and the files that it names, except references and campaigns. Error: one line.
Result<Suite> read_suite(const std::filesystem::path& folder);

/// The folders of suites within a folder, sorted by name. Error: one line; the folder contains no suite.
Result<std::vector<std::filesystem::path>> suites_in(const std::filesystem::path& folder);

}  // namespace canhil::accept
