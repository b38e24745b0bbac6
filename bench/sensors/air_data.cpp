#include "bench/sensors/air_data.hpp"

#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/units.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

// ISO 2533: the air cools by `lapse` up to the tropopause; above, its temperature is constant.
constexpr double sea_level_temperature = 288.15;  // [K]
constexpr double lapse = 6.5e-3;                  // [K/m]
constexpr double tropopause = 11'000;             // [m]
constexpr double gas_constant = 287.05287;        // of dry air [J/(kg K)]
constexpr double exponent = world::units::standard_gravity / (gas_constant * lapse);
constexpr double tropopause_temperature = sea_level_temperature - lapse * tropopause;
constexpr double scale_height = gas_constant * tropopause_temperature / world::units::standard_gravity;

double tropopause_pressure() { return standard_air(tropopause).pressure; }

constexpr std::array<Output, 6> values{{{"static_pressure", "Pa"},
                                        {"temperature", "K"},
                                        {"pressure_altitude", "m"},
                                        {"true_airspeed", "m/s"},
                                        {"angle_of_attack", "rad"},
                                        {"sideslip", "rad"}}};
constexpr std::int64_t usual_period_us = 50'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  AirDataSettings node;
  node.schedule = read_schedule(section);
  node.sea_level_pressure = section.number({"sea_level_hpa", "Pressure at sea level."},
                                           Limits::between(850, 1100), node.sea_level_pressure / 100);
  node.temperature_offset =
      section.number({"temperature_offset_k", "Difference of the temperature from the standard atmosphere."},
                     Limits::between(-60, 60), 0);
  node.wind = section.three({"wind_mps", "Wind, constant: velocity of the air over ground, [N, E, D]."});
  node.pressure_bias = read_constant(section, "pressure_bias_hpa", "the static pressure");
  node.pressure_noise = section.number(
      {"pressure_noise_hpa", "White noise of the static pressure, 1-sigma of a sample."}, sigma, 0);
  node.speed_scale = read_constant(section, "speed_scale_ppm", "the scale of the air speed");
  node.speed_noise =
      section.number({"speed_noise_mps", "White noise of the air speed, 1-sigma of a sample."}, sigma, 0);
  node.angle_bias = read_constant(section, "angle_bias_deg", "both angles of the flow");
  node.angle_noise = section.number(
      {"angle_noise_deg", "White noise of both angles of the flow, 1-sigma of a sample."}, sigma, 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

// The height above the ellipsoid is taken for the geopotential height: the difference, the undulation of the
// geoid and 0.03 % of the height, is an error of any device that is calibrated with such data.
class AirData final : public LossySampler<AirDataSettings> {
 public:
  AirData(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "air_data.loss"),
        stream_(run.stream("air_data")),
        pressure_bias_(draw(config_.pressure_bias, stream_)),
        scale_(1 + draw(config_.speed_scale, stream_)),
        angle_bias_(draw(config_.angle_bias, stream_)) {}

 private:
  // The flow in body axes is u = C_nb (v_eb_n - wind): air speed |u|, angle of attack atan(u_z / u_x),
  // sideslip asin(u_y / |u|) (Stevens, Lewis: Aircraft Control and Simulation, eq. (2.3-6)).
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const StandardAir air = standard_air(truth.position.height);
    const double pressure = air.pressure * config_.sea_level_pressure / standard_pressure + pressure_bias_ +
                            config_.pressure_noise * stream_.normal();
    const Vector3 u = truth.C_bn.transpose() * (truth.v_eb_n - config_.wind);
    const double speed = u.norm(), sideslip = speed > 0 ? std::asin(u.y() / speed) : 0;
    sample.values = {pressure,
                     air.temperature + config_.temperature_offset,
                     pressure_altitude(pressure),
                     scale_ * speed + config_.speed_noise * stream_.normal(),
                     std::atan2(u.z(), u.x()) + angle_bias_ + config_.angle_noise * stream_.normal(),
                     sideslip + angle_bias_ + config_.angle_noise * stream_.normal()};
  }

  world::Stream stream_;
  double pressure_bias_, scale_, angle_bias_;
};

}  // namespace

StandardAir standard_air(double height) {
  if (height > tropopause)
    return {tropopause_temperature, tropopause_pressure() * std::exp(-(height - tropopause) / scale_height)};
  const double temperature = sea_level_temperature - lapse * height;
  return {temperature, standard_pressure * std::pow(temperature / sea_level_temperature, exponent)};
}

double pressure_altitude(double pressure) {
  if (pressure < tropopause_pressure())
    return tropopause - scale_height * std::log(pressure / tropopause_pressure());
  return sea_level_temperature / lapse * (1 - std::pow(pressure / standard_pressure, 1 / exponent));
}

constinit const Kind air_data{.key = "air_data",
                              .read = read,
                              .make = make<AirData>,
                              .outputs = {.values = values},
                              .period_us = usual_period_us};

}  // namespace canhil::sensors
