// How a target responded to the faults of a flight. Only what it says and how it errs counts: no estimator is
// known here.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/signs.hpp"
#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::fault_matrix {

/// The name of the row that has none.
inline constexpr std::string_view no_fault = "no fault";

/// The checks that hold whatever befalls a target's inputs.
inline constexpr std::array<std::string_view, 3> judged_by{"honest", "answering", "counts_match"};
/// In place of a check's kind: the flight itself, whose target fell silent or broke a rule of the bus.
inline constexpr std::string_view flight_itself = "flight";

struct Response {
  enum class Kind : std::uint8_t {
    tolerated,    ///< not a word, and no error beyond its sigmas
    detected,     ///< the target says that something is wrong
    ended,        ///< it ended its estimation, and says why
    violated,     ///< it did what no fault excuses
    not_measured  ///< a check could not be judged
  };
  Kind kind = Kind::tolerated;
  std::optional<double> detected_s{};   ///< after the onset
  std::string by{};                     ///< the sign
  std::optional<double> recovered_s{};  ///< after the end of the faults; none: not within the flight
  std::string why{};                    ///< it ended, what is violated, or what could not be judged
  std::string check{};                  ///< that is violated
};

std::string_view name(Response::Kind kind);
/// None: no kind has this name.
std::optional<Response::Kind> kind_named(std::string_view name);

/// "detected in 0.020 s (coasting in an answer), recovered in 0.100 s".
std::string to_text(const Response& response);

/// What a flight without faults has, against which those with faults are held.
struct Undisturbed {
  std::vector<checks::Sign> signs{};
  std::vector<std::string> failed{};  ///< checks that fail, or cannot be judged, without a fault too
};
Undisturbed undisturbed(const scenario::Scenario& scenario, const drive::Run& run);

/// Of a flight of the matrix. What the undisturbed flight says at the same time is no response, nor is a
/// check that fails in it a violation; null: the flight is the undisturbed one.
Response response_of(const scenario::Scenario& scenario, const drive::Run& run, const Undisturbed* before);

}  // namespace canhil::fault_matrix
