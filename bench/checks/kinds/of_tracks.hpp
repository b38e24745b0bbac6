// Functions for the kinds of checks that judge quantities.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/rule.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::checks {

/// Reads `quantity`, and `estimator` if several running estimators report the quantity. Error: no running
/// estimator reports the quantity, or this kind of check cannot use the quantity.
Subject read_subject(scenario::Section& section, const scenario::CheckContext& context,
                     const std::function<bool(const quantities::Quantity&)>& wanted);
/// Reads `estimator`, which may be absent if there is only one candidate. Returns the name of the estimator.
std::string read_estimator(scenario::Section& section, const std::vector<std::string>& candidates,
                           std::string_view meaning);

/// Reads `from_s` and `to_s`, or `time_to_go_s` if the flight of the quantity's estimator goes to a target.
Stretch read_stretch(scenario::Section& section, const scenario::CheckContext& context,
                     const Subject& subject);

/// The value, converted to SI, of a key STEM_UNIT, and the unit of this key. For an angle the unit may be
/// mrad or deg.
std::pair<double, quantities::Unit> read_bar(scenario::Section& section, std::string_view stem,
                                             std::string_view meaning, const quantities::Quantity& quantity);

/// Like read_bar(), for a pair of values, [low, high].
std::pair<std::pair<double, double>, quantities::Unit> read_range(scenario::Section& section,
                                                                  std::string_view stem,
                                                                  std::string_view meaning,
                                                                  const quantities::Quantity& quantity);

/// The parts of a quantity, or the quantity itself if it has none.
std::vector<const quantities::Quantity*> parts_of(const quantities::Quantity& quantity);

/// The number of decimals with which values in this unit are shown.
int digits_of(const quantities::Unit& unit);

/// "from 1 to 2 s", "from 3 to 2 s to go".
std::string to_text(const Stretch& stretch);

/// Indices of a track's points.
using Places = Spool<std::size_t>;

/// The indices of the points within a stretch.
Places inside(const quantities::Track& track, const Stretch& stretch);

/// Describes where answers are missing in a stretch; empty: nowhere. `part`: the indices of the points in the
/// stretch.
std::string silence(const quantities::Track& track, const Stretch& stretch, const Places& part);

}  // namespace canhil::checks
