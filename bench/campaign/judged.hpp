// What is judged in a single run of a campaign: its checks, and its response to faults.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/matrix/response.hpp"
#include "bench/checks/verdict.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

struct Judged {
  std::vector<checks::CheckResult> checks{};
  std::optional<matrix::CellRun> response{};  ///< none: the campaign has no faults
};

/// One line of JSON; empty if nothing was judged.
std::string to_text(const Judged& judged);
/// Reads what to_text() made. Error: the text is something else.
Result<Judged> judged_in(const std::string& text);

}  // namespace canhil::campaign
