// `hil-bench campaign --paper NAME`: flies what a paper claims and writes one page on it.
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
  std::string paper;             ///< one of paper_names
  std::filesystem::path folder;  ///< is made; gets NAME.html and the campaigns' results, which are resumed
  std::optional<std::uint64_t> runs;  ///< a variant; none: as the campaigns say
  Rounding rounding = Rounding::as_on_the_bus;
  std::filesystem::path exact;  ///< results without rounding, to compare with; empty: none
  std::function<void(std::string_view campaign, std::size_t done, std::size_t total)> progress;
};

/// Bars that so few runs miss say nothing: `too_few_runs`.
enum class Outcome : std::uint8_t { bars_met, bars_missed, too_few_runs, interrupted };

/// `runs`: flown of each variant of the campaign with the bars, which are for `enough`.
Outcome outcome_of(bool bars_met, std::uint64_t runs, std::uint64_t enough);

struct Reproduced {
  Outcome outcome = Outcome::interrupted;
  std::string text;            ///< every table, for a terminal
  std::filesystem::path page;  ///< where the HTML is
};

/// Error, one line: unknown paper, folder not writable, gnuplot missing; all found before the first flight.
Result<Reproduced> reproduce(const Request& request, const std::atomic<bool>& stop);

}  // namespace canhil::papers
