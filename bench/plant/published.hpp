// What published figures show of the plants that they are about.
#pragma once

#include <optional>
#include <string_view>

#include "bench/world/attitude.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::plant {

/// The mean wind at a height [m], NED [m/s]. `season`: "march", "june", "september", "december"; none: no
/// such season.
std::optional<world::Vector3> published_wind(std::string_view season, double height);

/// The nominal flight through the wind of March, without errors and without a target: 100 s.
const world::PlantRecord& published_flight();

}  // namespace canhil::plant
