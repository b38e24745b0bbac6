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

/// Reads the key `quantity`. If several running estimators report this quantity, also reads the key
/// `estimator`. Error: no running estimator reports the quantity, or this kind of check cannot use the
/// quantity.
Subject read_subject(scenario::Section& section, const scenario::CheckContext& context,
                     const std::function<bool(const quantities::Quantity&)>& wanted);
/// Reads the key `estimator`, and returns the name of the estimator. If the key is absent, the check is read
/// for each candidate (CheckContext::each).
std::string read_estimator(scenario::Section& section, const std::vector<std::string>& candidates,
                           std::string_view meaning, const scenario::CheckContext& context);

/// Reads the keys `from_s` and `to_s`. If the flight that the estimator observes goes to a target, the key
/// `time_to_go_s` may replace these two keys. Also reads the key `while`.
Stretch read_stretch(scenario::Section& section, const scenario::CheckContext& context,
                     const Subject& subject);

/// Reads a key whose name is STEM_UNIT, such as below_deg. Returns its value, converted to SI, and its unit.
/// For an angle the unit may be mrad or deg.
std::pair<double, quantities::Unit> read_bar(scenario::Section& section, std::string_view stem,
                                             std::string_view meaning, const quantities::Quantity& quantity);

/// Like read_bar(), for a pair of values, [low, high].
std::pair<std::pair<double, double>, quantities::Unit> read_range(scenario::Section& section,
                                                                  std::string_view stem,
                                                                  std::string_view meaning,
                                                                  const quantities::Quantity& quantity);

/// The parts of a quantity. If the quantity has no parts, returns the quantity itself.
std::vector<const quantities::Quantity*> parts_of(const quantities::Quantity& quantity);

/// The number of decimals that are shown for a value in this unit. A value of the size of `limit`, in SI, has
/// at least two digits.
int digits_of(const quantities::Unit& unit, double limit);

/// "from 1 to 2 s", "from 3 to 2 s to go".
std::string to_text(const Stretch& stretch);

/// Indices of a track's points.
using Places = Spool<std::size_t>;

/// The indices of the points within a stretch at which its condition holds.
Places inside(const quantities::Track& track, const Stretch& stretch, const Evidence& evidence);

/// Describes where in the stretch answers are missing; empty: no answers are missing. `part`: the indices of
/// the track's points in the stretch.
std::string silence(const quantities::Track& track, const Stretch& stretch, const Places& part);

/// Why the track proves nothing in the stretch: answers are missing (fail), or the truth has no value there
/// or the condition does not hold at any of them (not measured); none: it can be judged.
std::optional<Finding> no_evidence(const quantities::Track& track, const Stretch& stretch, const Places& part,
                                   const Expected& expected, const Evidence& evidence);

}  // namespace canhil::checks
