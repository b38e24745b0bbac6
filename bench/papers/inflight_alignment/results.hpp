// The campaigns of the paper on in-flight alignment, flown, and the heading errors at 300 s by name.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/papers/flown.hpp"

namespace canhil::papers::inflight_alignment {

/// Heading error at 300 s over the runs of a variant [deg].
struct Heading {
  double rms = 0, rms_low = 0, rms_high = 0;  ///< 5 % to 95 % of the RMS of 100 runs
  double median = 0, p90 = 0;
  double below_10_deg = 0;  ///< fraction of runs
};
/// "9.3 [2.8-15.3] (0.87)": RMS, its range, median.
std::string words(const Heading& heading);

struct Results {
  std::vector<Flown> campaigns;
  std::uint64_t runs = 0;  ///< of the campaigns that carry the bars
  std::size_t flights = 0;
  /// RMS of the heading over the first 100 runs, by variant of the campaigns ssbl and gps: what the paper
  /// drew.
  std::map<std::string, std::vector<campaign::CurvePoint>, std::less<>> curves;

  [[nodiscard]] const Flown& of(std::string_view name) const { return papers::of(campaigns, name); }
  [[nodiscard]] Heading heading(std::string_view campaign, std::string_view variant,
                                std::string_view point = {}) const;
  /// Mean number of repairs of the covariance in a run.
  [[nodiscard]] double repairs(std::string_view campaign, std::string_view variant) const;
};

/// Flies what the folder does not hold yet. None: stopped. Error: one line.
Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop);

}  // namespace canhil::papers::inflight_alignment
