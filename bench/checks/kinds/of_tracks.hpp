// What kinds of checks that look at quantities have in common.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/rule.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::checks {

/// `quantity`, and `estimator` where several that run tell it. Error: none that runs tells it, or it is not
/// wanted.
Subject read_subject(scenario::Section& section, const scenario::CheckContext& context,
                     const std::function<bool(const quantities::Quantity&)>& wanted);
/// The estimator that `estimator` names, or the only one there is.
std::string read_estimator(scenario::Section& section, const std::vector<std::string>& candidates);

/// `from_s` and `to_s`, or `time_to_go_s` where the flight of the quantity's estimator has one.
Stretch read_stretch(scenario::Section& section, const scenario::CheckContext& context,
                     const Subject& subject);

/// A value as STEM and the ending of its unit, in SI, and that unit; angles in mrad or deg.
std::pair<double, quantities::Unit> read_bar(scenario::Section& section, std::string_view stem,
                                             std::string_view meaning, const quantities::Quantity& quantity);

/// The same of two values, [low, high].
std::pair<std::pair<double, double>, quantities::Unit> read_range(scenario::Section& section,
                                                                  std::string_view stem,
                                                                  std::string_view meaning,
                                                                  const quantities::Quantity& quantity);

/// What a quantity is made of: its parts, or itself.
std::vector<const quantities::Quantity*> parts_of(const quantities::Quantity& quantity);

/// As many as a figure in this unit has after its point.
int digits_of(const quantities::Unit& unit);

/// "from 1 to 2 s", "from 3 to 2 s to go".
std::string words(const Stretch& stretch);

/// Where in what a track told.
using Places = Spool<std::size_t>;

/// Of what was told in a stretch.
Places inside(const quantities::Track& track, const Stretch& stretch);

/// Where answers are missing in a stretch; empty: nowhere. `part`: the places of those that are there.
std::string silence(const quantities::Track& track, const Stretch& stretch, const Places& part);

}  // namespace canhil::checks
