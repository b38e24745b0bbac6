// What a target must do to be accepted as an estimator: a folder with suite.toml, the scenarios and campaigns
// that it names, and the reference answers (docs/accept.md).
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

/// What is asked, and under which heading.
struct Requirement {
  std::string id;
  std::string family;  ///< one of `families`
  std::string text;    ///< a sentence
};
inline const std::vector<std::string> families{"errors",           "honesty",  "algorithms", "parameters",
                                               "flags and states", "protocol", "timing"};

/// Another flight of the suite whose answers are to be the same.
struct SameAs {
  std::string flight;
  std::string requirement;
  double steps = 0;     ///< of each signal's resolution
  double relative = 0;  ///< to the value
};

/// A signal that a flight moves, beside another flight.
struct Move {
  std::string flight;  ///< beside which
  std::string message, signal;
  bool up = false;  ///< its mean magnitude is larger there, else smaller
  std::string requirement;
};

/// One flight in lockstep, or in real time.
struct Flight {
  std::string name;
  scenario::Scenario scenario{};
  std::string requirement{};  ///< of its checks that have none of the suite's themselves
  std::optional<std::string>
      reference{};       ///< requirement that its answers are the reference's; none: not asked
  std::size_t rows = 0;  ///< kept in the reference
  std::optional<SameAs> same_as{};
  std::optional<Move> moves{};
  bool real_time = false;
  bool faults = false;  ///< the target is to say that it cannot go on
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
      apply;                                   ///< a parameter that takes effect in flight; none: not asked
  std::optional<scenario::Scenario> dialogue;  ///< whose estimator is talked to; none: nobody is

  [[nodiscard]] const Requirement* find(std::string_view id) const;
  [[nodiscard]] std::filesystem::path reference_of(const Flight& flight) const;
};

/// Reads folder/suite.toml and what it names but references and campaigns. Error: one line.
Result<Suite> read_suite(const std::filesystem::path& folder);

/// The folders of the suites in a folder, by name. Error: one line; there is none.
Result<std::vector<std::filesystem::path>> suites_in(const std::filesystem::path& folder);

}  // namespace canhil::accept
