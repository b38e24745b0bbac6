// The response of a target to the faults of a flight, judged by its reports and its errors alone, without
// knowledge of the estimator.
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

/// The name of the row without faults.
inline constexpr std::string_view no_fault = "no fault";

/// The checks that must hold in spite of any fault in the target's inputs.
inline constexpr std::array<std::string_view, 3> judged_by{"honest", "answering", "counts_match"};
/// Stands in place of a check's kind if the flight itself failed: the target became silent or violated the
/// protocol.
inline constexpr std::string_view flight_itself = "flight";

struct Response {
  enum class Kind : std::uint8_t {
    tolerated,    ///< no sign, and no error beyond the sigmas
    detected,     ///< the target reports trouble
    ended,        ///< the target ended its estimation and reported why
    violated,     ///< a violation that no fault excuses
    not_measured  ///< a check could not be judged
  };
  Kind kind = Kind::tolerated;
  std::optional<double> detected_s{};   ///< delay from the onset of the faults
  std::string by{};                     ///< the first sign of trouble
  std::optional<double> recovered_s{};  ///< delay from the end of the faults; none: not within the flight
  std::string why{};                    ///< why the flight ended, or why a check failed or was not judged
  std::string check{};                  ///< the violated check
};

std::string_view name(Response::Kind kind);
/// None: unknown name.
std::optional<Response::Kind> kind_named(std::string_view name);

/// "detected in 0.020 s (coasting in an answer), recovered in 0.100 s".
std::string to_text(const Response& response);

/// The reference flight without faults, for comparison.
struct Undisturbed {
  std::vector<checks::Sign> signs{};
  std::vector<std::string> failed{};  ///< checks that fail or cannot be judged even without a fault
};
Undisturbed undisturbed(const scenario::Scenario& scenario, const drive::Run& run);

/// The response in a flight of the matrix. Signs that occur at the same time in the undisturbed flight are
/// not counted as a response; checks that fail in it are not counted as violations. Null: this is the
/// undisturbed flight.
Response response_of(const scenario::Scenario& scenario, const drive::Run& run, const Undisturbed* before);

}  // namespace canhil::fault_matrix
