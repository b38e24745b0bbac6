// The sections of the page on the LOS rate.
#pragma once

#include "bench/papers/los_rate/results.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers::los_rate {

/// What the paper claims and what the bars of the reproduction ask, each with its verdict.
Section claims(const Results& results);
/// Whether every bar is met.
bool bars_met(const Results& results);

/// Fig 2: RMS of the LOS rate against the time to go.
Section open_loop(const Results& results);
/// Fig 3: bandwidth against range and closing speed.
Section closing_speed(const Results& results);
/// What is a property of the formulas: where it is tested.
Section formulas();
/// Miss when each filter guides, and against latency and jitter.
Section closed_loop(const Results& results);
Section delays(const Results& results);
/// Correlated glint.
Section glint(const Results& results);
Section settings(const Results& results);

}  // namespace canhil::papers::los_rate
