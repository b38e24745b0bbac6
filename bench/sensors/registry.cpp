// One line for each kind of sensor.
#include "bench/sensors/registry.hpp"

#include <array>

#include "bench/sensors/fins.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/seeker.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/ssbl.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array registered{
    &master_ins,  // of the carrier
    &slave_imu,   // of the weapon, or of the vehicle
    &ssbl,        // of a ship
    &gps,         // of the vehicle
    &seeker,      // of a missile
    &glider_nav,  // the GPS/INS of the glider
    &fins,        // of the glider
};

}  // namespace

std::span<const Kind* const> all() { return registered; }

}  // namespace canhil::sensors
