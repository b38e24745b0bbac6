// The campaigns of the transfer-alignment paper, flown, and their answers by name.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/evaluate.hpp"

namespace canhil::papers::transfer_alignment {

using campaign::CurvePoint;
using campaign::Quantity;

/// A campaign of bench/campaigns/paper_transfer with its answers.
struct Flown {
  std::string name;  ///< of the file, without its ending
  campaign::Campaign campaign;
  campaign::Evaluation evaluation;

  /// RMS over runs of a variant, by its name in the file and its point of the sweep; they must exist.
  [[nodiscard]] std::span<const CurvePoint> curve(std::string_view variant, std::string_view point = {},
                                                  Quantity quantity = Quantity::heading) const;
  /// "27 of 300 runs (0 ended early)": runs beyond 20 mrad at the end, where the campaign counts them.
  [[nodiscard]] std::string diverged_runs(std::string_view variant, std::string_view point = {}) const;
  /// Answers that carry a requirement.
  [[nodiscard]] std::vector<const campaign::Answer*> answers(std::string_view requirement) const;
};

/// When the RMS of the heading enters 3, 2 and 1 mrad for good [s].
inline constexpr double never = std::numeric_limits<double>::infinity();
struct Times {
  double within_3_mrad = never, within_2_mrad = never, within_1_mrad = never;
  double end_mrad = 0;  ///< RMS at the last update; NaN: no run came there
};
Times times_of(std::span<const CurvePoint> curve);
/// "14.7 / 16.2 / never"; "diverges (71 mrad)" where the heading is beyond 20 mrad at the end.
std::string words(const Times& times);
bool diverged(const Times& times);

/// Smallest and largest of ten batches' times.
struct Spread {
  Times low, high;
};

struct Results {
  std::uint64_t runs = 0;
  std::size_t flights = 0;
  bool rounded = true;  ///< frames as on the bus; false: flown by the twin that rounds nothing
  std::vector<Flown> campaigns;
  std::vector<std::pair<std::string, Spread>> spreads;  ///< by variant of table2
  std::optional<Flown> exact;                           ///< table2 without the rounding of the bus

  [[nodiscard]] const Flown& of(std::string_view name) const;
};

struct Options {
  std::filesystem::path folder;       ///< for the results, NAME.sqlite; must exist
  std::optional<std::uint64_t> runs;  ///< in place of the campaigns' own number
  std::filesystem::path exact;        ///< results of table2 by the twin without rounding; empty: none
  std::function<void(std::string_view campaign, std::size_t done, std::size_t total)> progress;
};

/// "frames quantised as on the bus", or that they were not.
std::string frames_of(const Results& results);

/// Flies what the folder does not hold yet. None: stopped. Error: one line.
Result<std::optional<Results>> fly(const Options& options, const std::atomic<bool>& stop);

}  // namespace canhil::papers::transfer_alignment
