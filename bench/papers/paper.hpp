// `hil-bench campaign --paper NAME`: flies the campaigns of a paper and writes a page about its claims.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::papers {

struct Request {
  std::string paper;                  ///< one of paper_names
  std::filesystem::path folder;       ///< for NAME.html and the campaigns' results; created if missing. The
                                      ///< runs of earlier results in the folder are not flown again
  std::optional<std::uint64_t> runs;  ///< per variant; none: as in the campaigns
  Rounding rounding = Rounding::as_on_the_bus;
  std::filesystem::path exact;  ///< results without rounding for comparison; empty: none
  std::function<void(std::string_view campaign, std::size_t done, std::size_t total)> progress;
};

/// too_few_runs: the limits were not met, but the number of runs is too small for a verdict.
enum class Outcome : std::uint8_t { bars_met, bars_missed, too_few_runs, interrupted };

/// `runs`: the number of runs for each variant of the campaign that has the limits. `enough`: the number of
/// runs for which the limits were derived.
Outcome outcome_of(bool bars_met, std::uint64_t runs, std::uint64_t enough);

struct Reproduced {
  Outcome outcome = Outcome::interrupted;
  std::string text;            ///< all tables, for a terminal
  std::filesystem::path page;  ///< path of the HTML page
};

/// It is an error if the paper is unknown, the folder is not writable or gnuplot is missing; all this is
/// checked before the first flight. The error is one line of text.
Result<Reproduced> reproduce(const Request& request, const std::atomic<bool>& stop);

}  // namespace canhil::papers
