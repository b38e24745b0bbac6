// The sections of the page on in-flight alignment.
#pragma once

#include <vector>

#include "bench/papers/inflight_alignment/results.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers::inflight_alignment {

/// What the paper claims and what the bars of the reproduction ask, each with its verdict.
Section claims(const Results& results);
/// Whether every bar is met.
bool bars_met(const Results& results);

/// Figs 5 to 10: heading against time, and all filters at 300 s.
Section figures(const Results& results);
/// Starts of 30 to 180 deg.
Section starts(const Results& results);
/// The order of the filters on other S paths.
Section paths(const Results& results);
/// Open and closed loop, the UKF's root and covariance, lost positive definiteness.
Section forms(const Results& results);
/// Late fixes with and without their time of validity.
Section late_fixes(const Results& results);
/// Lost groups of the IMU, lost fixes, outliers.
Section losses(const Results& results);
Section settings(const Results& results);

}  // namespace canhil::papers::inflight_alignment
