// The sections of the page on wind estimation.
#pragma once

#include "bench/papers/page.hpp"
#include "bench/papers/wind/results.hpp"

namespace canhil::papers::wind {

/// What the paper claims and what the bars of the reproduction ask, each with its verdict.
Section claims(const Results& results);
/// Whether every bar is met.
bool bars_met(const Results& results);

/// Table 1 with the paper's columns, and Figs 7 to 9: the error against time.
Section table_1(const Results& results);
/// Figs 3 to 6: the wind over the height, and the glide.
Section glide(const Results& results);
/// The ways in which coefficients may be wrong.
Section models(const Results& results);
/// Density, constant coefficients, gusts, correlated navigation, headings and seasons.
Section sensitivity(const Results& results);
/// Rate, age of the fins, lost samples.
Section timing(const Results& results);
Section settings(const Results& results);

}  // namespace canhil::papers::wind
