// Times of this run beside those of the reference simulation.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/papers/page.hpp"
#include "bench/papers/transfer_alignment/results.hpp"

namespace canhil::papers::transfer_alignment {

/// Into 3, 2 and 1 mrad [s].
inline Times times(double within_3, double within_2, double within_1) {
  return {within_3, within_2, within_1, 0};
}
/// The paper's table 2, both filters told 1 deg: all that is known of its curves in figures.
inline const Times paper_kalman = times(14.4, 15.6, never);
inline const Times paper_h2 = times(11.4, 11.7, 12.9);
inline const Times diverges{.within_3_mrad = never,
                            .within_2_mrad = never,
                            .within_1_mrad = never,
                            .end_mrad = std::numeric_limits<double>::quiet_NaN()};

/// A row of a table with `compared_head`: agrees, or differs.
Row compared(std::string filter, const Times& reference, std::span<const CurvePoint> curve,
             std::uint64_t runs, double step_s = 0.1);
/// A row without a verdict.
Row recorded(std::string filter, std::string reference, std::span<const CurvePoint> curve);

extern const std::vector<std::string> compared_head;
extern const char* const times_note;

/// A point of a sweep over one key of the master.
std::string point(std::string_view key, std::string_view value);

}  // namespace canhil::papers::transfer_alignment
