// Air data: static pressure, temperature and pressure altitude of the standard atmosphere, air speed and
// angles of the flow.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The pressure of the standard atmosphere at sea level [Pa].
inline constexpr double standard_pressure = 101'325;

/// The table [air_data].
struct AirDataSettings {
  scenario::Schedule schedule{};
  double sea_level_pressure = standard_pressure;  ///< [Pa]
  double temperature_offset = 0;                  ///< from the standard atmosphere [K]
  world::Vector3 wind = world::Vector3::Zero();   ///< of the air relative to the ground, NED [m/s]
  world::RandomValue pressure_bias{};             ///< [Pa]
  double pressure_noise = 0;                      ///< 1-sigma of a sample [Pa]
  world::RandomValue speed_scale{};               ///< scale factor error of the air speed
  double speed_noise = 0;                         ///< 1-sigma of a sample [m/s]
  world::RandomValue angle_bias{};                ///< of both angles of the flow [rad]
  double angle_noise = 0;                         ///< 1-sigma of a sample [rad]
  SampleLoss loss{};
};

extern const struct Kind air_data;

/// Temperature [K] and pressure [Pa] of the standard atmosphere (ISO 2533) at a geopotential height [m] from
/// -2000 to 20,000 m.
struct StandardAir {
  double temperature = 0, pressure = 0;
};
StandardAir standard_air(double height);
/// The height [m] at which the standard atmosphere has a pressure [Pa]: the inverse of standard_air().
double pressure_altitude(double pressure);

}  // namespace canhil::sensors
