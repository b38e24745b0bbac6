// The requirements that a target must meet to be accepted as an estimator. A suite is a folder: it contains
// suite.toml, and the scenarios and campaigns that suite.toml names (docs/accept.md).
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
  std::string text;    ///< one sentence that states the requirement
};
inline const std::vector<std::string> families{"errors",           "honesty",  "algorithms", "parameters",
                                               "flags and states", "protocol", "timing"};

/// Refers to another flight of the suite. The answers of that flight must be the same as those of this
/// flight.
struct SameAs {
  std::string flight;
  std::string requirement;
  double steps = 0;     ///< tolerance of a value, in steps of its signal
  double relative = 0;  ///< tolerance of a value, relative to the value
};

/// A signal whose mean must differ between this flight and another one. Both have the same noise, so the
/// difference is the response to what distinguishes the flights.
struct Move {
  std::string flight{};  ///< the other flight
  std::string message, signal;
  bool up = false;  ///< true: the magnitude of the mean must be larger in this flight; false: smaller
  /// Instead of `up`: the limits of the mean difference, here minus there, in the unit of the signal.
  std::optional<std::pair<double, double>> by{};
  /// Instead of `up`: the bench time [s] of the first answer in which the signal differs.
  std::optional<double> first_at_s{};
  std::string requirement{};
};

/// A flight in lockstep or in real time.
struct Flight {
  std::string name;
  scenario::Scenario scenario{};
  std::string requirement{};  ///< id: applies to checks that name no requirement of the suite
  std::optional<std::string>
      reference{};       ///< id of the requirement that the answers are hil-target's; none: not compared
  std::size_t rows = 0;  ///< number of instants that are compared
  std::optional<SameAs> same_as{};
  std::vector<Move> moves{};
  bool real_time = false;
  bool faults = false;  ///< true: the target must report a fault
};

using conformance::Parameter;

struct Suite {
  std::filesystem::path folder;
  std::string title;
  std::string estimator;
  std::vector<Requirement> requirements;
  std::vector<Flight> flights;
  std::vector<Parameter> parameters;
  std::vector<std::string> campaigns;  ///< names of campaign files in the folder
  std::optional<std::pair<std::string, double>>
      apply;  ///< name and value of a parameter that takes effect in flight; none: not tested
  std::optional<scenario::Scenario> dialogue;  ///< scenario with the dialogue's estimator; none: no dialogue

  [[nodiscard]] const Requirement* find(std::string_view id) const;
};

/// Reads folder/suite.toml and the scenarios that it names; campaigns are not read. An Error has one line.
Result<Suite> read_suite(const std::filesystem::path& folder);

/// The folders within `folder` that contain a suite, sorted by name. Returns an Error of one line if there is
/// none.
Result<std::vector<std::filesystem::path>> suites_in(const std::filesystem::path& folder);

}  // namespace canhil::accept
