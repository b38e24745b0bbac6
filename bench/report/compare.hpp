// Finds what got worse between runs of a scenario.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::report {

enum class Comparison : std::uint8_t { no_worse, worse, not_comparable };

struct Compared {
  Comparison outcome = Comparison::no_worse;
  std::string text;  ///< one line for each compared item; the last line is the outcome
};

using Reports = std::vector<nlohmann::ordered_json>;

/// Compares the reports `after` with the reports `before`. Each side has at least one report, made by
/// document(). An error is one line of text: what a report lacks, or which value in a report is unknown.
Result<Compared> compare(const Reports& before, const Reports& after);

}  // namespace canhil::report
