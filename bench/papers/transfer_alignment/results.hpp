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

#include "bench/papers/flown.hpp"

namespace canhil::papers::transfer_alignment {

using campaign::CurvePoint;
using campaign::Quantity;

/// "27 of 300 runs (0 ended early)": runs beyond 20 mrad at the end, where the campaign counts them.
std::string diverged_runs(const Flown& flown, std::string_view variant, std::string_view point = {});

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
  std::vector<Flown> campaigns;
  std::vector<std::pair<std::string, Spread>> spreads;  ///< by variant of table2
  std::optional<Flown> exact;                           ///< table2 without the rounding of the bus

  [[nodiscard]] const Flown& of(std::string_view name) const { return papers::of(campaigns, name); }
};

/// Flies what the folder does not hold yet. `exact`: results of table2 by the twin without rounding; empty:
/// none. None: stopped. Error: one line.
Result<std::optional<Results>> fly(const FlyOptions& options, const std::filesystem::path& exact,
                                   const std::atomic<bool>& stop);

}  // namespace canhil::papers::transfer_alignment
