// The measurement uncertainty of the latencies of a run, after the GUM (JCGM 100:2008). Each influence is of
// type B and has a rectangular distribution with half-width a; its standard uncertainty u is a / sqrt(3). The
// combined uncertainty is the root of the sum of the squares of all u.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/drive/session.hpp"

namespace canhil::report {

/// The coverage factor k: the expanded uncertainty U is k times the combined standard uncertainty u. With k
/// equal to 2, about 95 % of the values of a normal distribution lie within U.
inline constexpr double coverage_factor = 2;

/// The sources of uncertainty of a latency.
enum class Influence : std::uint8_t {
  stamps,  ///< resolution of the two stamps
  clock,   ///< rate error of the clock that makes both stamps
  host,    ///< delay until the kernel or the bench stamps a frame
  wire,    ///< two nodes see the end of a frame up to one bit apart
  figure,  ///< width of the bucket that the quantile comes from
};
inline constexpr std::array<std::string_view, 5> influence_names{"stamps", "clock", "host", "wire", "figure"};

/// How the stamps of a run were taken.
struct StampConditions {
  bool hardware = false;        ///< the controller stamped stimuli and answers
  bool simulated_wire = false;  ///< stamps are computed, not read
  double usb_poll_s = 0;        ///< interval between polls of a USB adapter; 0: no USB, or hardware stamps
  double bit_s = 0;             ///< duration of a bit; 0: no wire, or unknown bit rate
  bool wire_unknown = false;    ///< there is a wire, but its bit rate is unknown
  bool echoed = true;           ///< the stimulus was stamped on the bus, not by the bench
};
StampConditions stamp_conditions(const drive::Run& run);

/// The half-width [s] of each Influence, in the order of the enumeration, for a latency [s]. `lateness_s`:
/// the lateness of the bench at the same quantile. `bucket_s`: the width of the histogram bucket that
/// contains the latency; 0: the latency is exact.
std::array<double, 5> half_widths_s(const StampConditions& conditions, double latency_s, double lateness_s,
                                    double bucket_s);
/// The standard uncertainty u [s] of one influence. For `stamps`, the half-width is that of a single stamp,
/// and the result is for two stamps.
double standard_s(Influence influence, double half_width_s);
/// The combined standard uncertainty [s]: the root of the sum of the squares of the standard uncertainties of
/// all influences.
double combined_s(const std::array<double, 5>& half_widths_s);

/// A figure of a latency, with its uncertainty budget.
struct UncertainFigure {
  std::string_view name;  ///< "p50"
  double value_s = 0;
  std::array<double, 5> half_width_s{};
  double expanded_s = 0;  ///< coverage_factor times the combined standard uncertainty
};
struct UncertainLatency {
  std::string message;
  std::vector<UncertainFigure> figures;  ///< p50, p90, p99, p999, max
};

/// The uncertainties of the latencies of the messages that close a group of answers. Empty unless the run was
/// in real time.
std::vector<UncertainLatency> uncertainties(const scenario::Scenario& scenario, const drive::Run& run);

/// Known influences that the budget does not include, one line each; empty: no such influence is known.
std::vector<std::string> left_out(const StampConditions& conditions);

/// The part of the text report with a line for each message; empty: there are no such messages.
std::string uncertainty_text(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
