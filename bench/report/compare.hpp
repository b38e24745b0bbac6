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

/// The largest loss of a check's margin that does not count as worse, as a share of the limit.
inline constexpr double usual_tolerance = 0.1;

/// Compares the reports `after` with the reports `before`. Each side has at least one report, made by
/// document(). `tolerance`: see usual_tolerance. An error is one line of text: what a report lacks, or which
/// value in a report is unknown.
Result<Compared> compare(const Reports& before, const Reports& after, double tolerance = usual_tolerance);

}  // namespace canhil::report
