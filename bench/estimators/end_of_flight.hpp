// How the flight of a missile ended: shared by the estimators whose answers may guide it.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/checks/results.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::estimators {

/// The closest approach of a missile and its target.
struct Passage {
  std::optional<world::Vector3> miss_n{};  ///< target relative to missile [m]; none: not reached
  std::int64_t t_us = 0;                   ///< its time
  std::uint64_t late_commands = 0;         ///< number of answers that came after the time of their command

  /// None: no plant has a missile.
  static std::optional<Passage> find(const world::PlantRecords& plants);
};

/// A result line: the closest approach, its time, and how many answers came too late to guide.
ResultLine end_of_flight(const Passage& passage);
/// The time [us] after which no sample needs an answer: the passage, if the missile passed its target.
std::int64_t answers_end_us(const world::PlantRecords& plants, std::int64_t duration_us);

}  // namespace canhil::estimators
