// The response of a target to the faults of a flight. The response is judged only by the reports of the
// target and by the errors of its answers, without knowledge of the estimator.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/signs.hpp"
#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::campaign::matrix {

/// The name of the row without faults.
inline constexpr std::string_view no_fault = "no fault";

/// The checks that must hold in spite of any fault in the target's inputs.
inline constexpr std::array<std::string_view, 3> judged_by{"honest", "answering", "counts_match"};
/// Used in place of the kind of a check if the flight itself failed: the target became silent or violated the
/// protocol.
inline constexpr std::string_view flight_itself = "flight";

struct Response {
  enum class Kind : std::uint8_t {
    tolerated,    ///< no sign of trouble, and no error beyond the sigmas
    detected,     ///< the target reports trouble
    ended,        ///< the target ended its estimation and reported why
    violated,     ///< the target violated a requirement that no fault excuses
    not_measured  ///< a check could not be judged
  };
  Kind kind = Kind::tolerated;
  std::optional<double> detected_s{};   ///< time from the onset of the faults
  std::string by{};                     ///< the first sign of trouble
  std::optional<double> recovered_s{};  ///< time from the end of the faults; none: not recovered
  std::string why{};                    ///< why the flight ended, or why a check failed or was not judged
  std::string check{};                  ///< the violated check
};

std::string_view name(Response::Kind kind);

/// The result of a run of a cell.
struct CellRun {
  std::vector<std::string> faults{};  ///< one line for each fault
  Response response{};
  std::string replay{};              ///< for a violation: file of the minimal scenario that shows it
  std::string target{};              ///< for a violation: command of the target; empty: in process
  std::vector<std::string> least{};  ///< the faults of the minimal scenario
};
/// The keys `faults`, `response`, `detected_s`, `by`, `recovered_s`, `why`, `check`, `replay`, `target` and
/// `least`; those without a value are left out.
nlohmann::ordered_json json_of(const CellRun& run);
/// Reads what json_of() made. Throws nlohmann::json::exception if it is something else.
CellRun cell_run_in(const nlohmann::ordered_json& json);

/// A text such as "detected in 0.020 s (coasting in an answer), recovered in 0.100 s".
std::string to_text(const Response& response);

/// The same flight without faults, for comparison.
struct Undisturbed {
  std::vector<checks::Sign> signs{};
  std::vector<std::string> failed{};  ///< checks that fail or cannot be judged even without a fault
};
Undisturbed undisturbed(const scenario::Scenario& scenario, const drive::Run& run);

/// The response in a flight of the matrix. `before`: the undisturbed flight; null if `run` itself is the
/// undisturbed flight. Signs that occur at the same time in the undisturbed flight are not counted as a
/// response. Checks that fail in the undisturbed flight are not counted as violations.
Response response_of(const scenario::Scenario& scenario, const drive::Run& run, const Undisturbed* before);

}  // namespace canhil::campaign::matrix
