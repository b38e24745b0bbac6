// The sections of the page on the transfer-alignment paper.
#pragma once

#include <vector>

#include "bench/papers/page.hpp"
#include "bench/papers/transfer_alignment/results.hpp"

namespace canhil::papers::transfer_alignment {

/// What the paper claims and what the bars of the reproduction ask, each with its verdict.
Section claims(const Results& results);
/// Whether every bar is met.
bool bars_met(const Results& results);

// Times by times with the reference simulation.
Section table_2(const Results& results);
Section cases(const Results& results);
Section cruise(const Results& results);
Section sizes(const Results& results);
Section axes(const Results& results);
Section artefact(const Results& results);
Section noise(const Results& results);
Section rates(const Results& results);
/// What the rounding of the bus costs; without results of the twin it says how to get them.
Section cost_of_the_bus(const Results& results);
Section settings(const Results& results);

// The figures of these sections.
std::vector<Figure> case_figures(const Results& results);
std::vector<Figure> cruise_figures(const Results& results);
std::vector<Figure> size_figures(const Results& results);
std::vector<Figure> axis_figures(const Results& results);
std::vector<Figure> artefact_figures(const Results& results);
std::vector<Figure> noise_figures(const Results& results);

/// RMS of the heading [mrad] at the last update at or before a time.
double heading_mrad(std::span<const CurvePoint> curve, double t_s);
/// RMS over curves of equal times.
std::vector<CurvePoint> pooled(const std::vector<std::span<const CurvePoint>>& curves);
/// The eight combinations of signs of campaign `cruise`, pooled.
std::vector<CurvePoint> all_signs(const Results& results);

}  // namespace canhil::papers::transfer_alignment
