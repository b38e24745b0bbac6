// The results of checks as JSON, and back.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "bench/checks/verdict.hpp"

namespace canhil::report {

/// The entry of a check in the key `checks` of a report. Numbers that the check does not have are left out.
nlohmann::ordered_json object(const checks::CheckResult& check);

/// The outcome with this name; none: there is no such outcome.
std::optional<checks::Outcome> outcome_named(std::string_view name);

/// The numbers of an entry of `checks`, without its window. Throws nlohmann::json::exception if a number is
/// not a number.
checks::Judgement judgement_of(const nlohmann::ordered_json& check);

}  // namespace canhil::report
