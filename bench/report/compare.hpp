// What got worse from some runs of a scenario to others.
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
  std::string text;  ///< a line for each thing compared, the last one the outcome
};

using Reports = std::vector<nlohmann::ordered_json>;

/// Compares reports as document() makes them, `after` against `before`, one at least on each side. Error: one
/// line, what a report lacks or has that is not known.
Result<Compared> compare(const Reports& before, const Reports& after);

}  // namespace canhil::report
