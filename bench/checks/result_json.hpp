// The results of checks as JSON, and back.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "bench/checks/verdict.hpp"

namespace canhil::checks {

/// The entry of a check in the key `checks` of a report. Numbers that the check does not have are left out.
nlohmann::ordered_json json_of(const CheckResult& check);

/// Adds the numbers of a judgement to an entry.
void add_numbers(nlohmann::ordered_json& entry, const Judgement& judgement);

/// The result in such an entry, without its window. Throws nlohmann::json::exception if the entry is not of
/// this form.
CheckResult result_in(const nlohmann::ordered_json& check);

/// The outcome with this name; none: there is no such outcome.
std::optional<Outcome> outcome_named(std::string_view name);

/// The numbers of an entry of `checks`, without its window. Throws nlohmann::json::exception if a number is
/// not a number.
Judgement judgement_of(const nlohmann::ordered_json& check);

}  // namespace canhil::checks
