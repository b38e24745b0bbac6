// One line for each kind of plant.
#include "bench/plant/registry.hpp"

#include <array>

#include "bench/plant/engagement/read.hpp"
#include "bench/plant/fmu/fmu.hpp"
#include "bench/plant/glide/read.hpp"
#include "bench/plant/hover.hpp"
#include "bench/plant/program.hpp"
#include "bench/plant/steered_heading.hpp"

namespace canhil::plant {
namespace {

constexpr std::array registered{
    &fmu_plant,        // a model that another tool exported (FMI 2.0, FMI 3.0)
    &hover,            // a small rotorcraft: attitude and position by thrust and body rates
    &program,          // a program of the user, in any language
    &steered_heading,  // a ship or a car: heading by a rudder or a steering actuator
};

constexpr std::array with_tables{
    &engagement::table,  // a missile and its flight target
    &glide::table,       // a glider in the wind
};

}  // namespace

std::span<const Kind* const> kinds() { return registered; }
std::span<const scenario::PlantTable* const> tables() { return with_tables; }

}  // namespace canhil::plant
