// The times from which the heading's RMS over runs stays within 3, 2 and 1 mrad: the form in which the
// transfer-alignment paper gives its results.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/statistics.hpp"
#include "bench/campaign/store.hpp"

namespace canhil::papers::transfer_alignment {

using campaign::CurvePoint;

/// The time of a level that is never reached [s].
inline constexpr double never = std::numeric_limits<double>::infinity();
struct Times {
  double within_3_mrad = never, within_2_mrad = never, within_1_mrad = never;
  double end_mrad = 0;  ///< RMS at the last update; NaN: no run reached it
};
Times times_of(std::span<const CurvePoint> curve);
/// Parses "14.7 / 16.2 / never", with or without spaces, or "diverges". Throws std::logic_error if a number
/// cannot be parsed.
Times times_in(std::string text);
/// Returns a text such as "14.7 / 16.2 / never", or "diverges (71 mrad at the end)" if the heading error is
/// beyond 20 mrad at the end.
std::string words_of(const Times& times);
bool diverged(const Times& times);

/// "14.7", or "never".
std::string time_words(double t_s);

/// Whether the times of a curve agree with those of the reference, a simulation of 150 runs. `runs`: the
/// number of runs from which the curve was computed.
bool agrees(std::span<const CurvePoint> curve, const Times& reference, std::uint64_t runs);

/// The spread of the times of each variant, as text: the runs are divided into ten batches, and the text
/// contains the smallest and the largest time over the batches. The map is empty if there are fewer than ten
/// runs.
Result<std::map<std::string, std::string, std::less<>>> spreads_of(const campaign::Campaign& campaign,
                                                                   const campaign::Store& store);

}  // namespace canhil::papers::transfer_alignment
