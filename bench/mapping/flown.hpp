// The values that a flight plays to targets with a mapping: their ranges and their noise.
#pragma once

#include <limits>
#include <map>

#include "bench/mapping/mapping.hpp"
#include "bench/sensors/kind.hpp"

namespace canhil::mapping {

/// What a flight plays in a signal, in the unit of the signal.
struct PlayedValues {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double noise = 0;  ///< 1-sigma of the error that is white from sample to sample
};
using FlownValues = std::map<const Source*, PlayedValues>;

/// The values of two runs of a scenario, without a bus. The runs have other random numbers. The truth is the
/// same in both, so the change from sample to sample of the difference of their values has the variance 4
/// sigma^2, and what changes slowly in the errors is small in it.
FlownValues flown_values(const Mapping& mapping, const sensors::Run& one, const sensors::Run& other);

}  // namespace canhil::mapping
