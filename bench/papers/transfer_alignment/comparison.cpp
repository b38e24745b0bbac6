#include "bench/papers/transfer_alignment/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::papers::transfer_alignment {
namespace {

constexpr double acceleration_begins_s = 10;

// Two samples of runs of one filter. The RMS of n runs has a relative sigma of 1/sqrt(2 n); heading falls
// like (t - 10 s)^-p, so a time's sigma is (t - 10 s)/(p sqrt(2 n)). With p = 1.5 (3 to 2 mrad) three sigmas
// of the difference of 300 and 150 runs are 15 % of (t - 10 s); to 1 mrad, where curves flatten, the spread
// of batches of 30 gives 35 %. One update is added. Never is as good as a time beyond 18 s: batches gave 18.9
// s to never.
bool close(double ours, double reference, double part, double step_s) {
  constexpr double as_good_as_never_s = 18;
  if (std::isinf(ours) || std::isinf(reference)) return std::min(ours, reference) >= as_good_as_never_s;
  return std::abs(ours - reference) <=
         step_s + part * (std::min(ours, reference) - acceleration_begins_s) + 1e-6;
}

bool agree(const Times& ours, const Times& reference, double step_s, std::uint64_t runs) {
  if (diverged(ours) || diverged(reference)) return diverged(ours) && diverged(reference);
  const double fewer = std::sqrt((1.0 / static_cast<double>(runs) + 1.0 / 150) / (1.0 / 300 + 1.0 / 150));
  return close(ours.within_3_mrad, reference.within_3_mrad, 0.15 * fewer, step_s) &&
         close(ours.within_2_mrad, reference.within_2_mrad, 0.15 * fewer, step_s) &&
         close(ours.within_1_mrad, reference.within_1_mrad, 0.35 * fewer, step_s);
}

}  // namespace

Row compared(std::string filter, const Times& reference, std::span<const CurvePoint> curve,
             std::uint64_t runs, double step_s) {
  const Times ours = times_of(curve);
  const bool same = agree(ours, reference, step_s, runs);
  return {.cells = {std::move(filter), words(reference), words(ours)},
          .mark = same ? Mark::yes : Mark::no,
          .verdict = same ? "agrees" : "differs"};
}

Row recorded(std::string filter, std::string reference, std::span<const CurvePoint> curve) {
  return {.cells = {std::move(filter), std::move(reference), words(times_of(curve))},
          .mark = Mark::none,
          .verdict = "recorded"};
}

const std::vector<std::string> compared_head{"filter", "reference", "over the bus", "verdict"};
const char* const times_note =
    "Time [s] from which the 1σ heading error (RMS over runs) stays within 3 / 2 / 1 mrad. Reference: a "
    "separate simulation in "
    "double precision, without a bus. 'Agrees': within one update plus 15 % (3, 2 mrad) or 35 % (1 mrad) of "
    "the time since the "
    "acceleration began, which is three sigmas of the difference of two such samples of runs.";

std::string point(std::string_view key, std::string_view value) {
  return fmt::format("master_ins.{}={}", key, value);
}

}  // namespace canhil::papers::transfer_alignment
