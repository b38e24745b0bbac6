#include "bench/sensors/magnetometer.hpp"

#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/error_stack.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/mounting.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr std::array<Output, 4> values{
    {{"field_x", "T"}, {"field_y", "T"}, {"field_z", "T"}, {"heading", "rad", true}}};
constexpr std::int64_t usual_period_us = 50'000;

// The field of strength F, inclination I (down) and declination D (east): F (cos I cos D, cos I sin D, sin
// I).
Vector3 read_field(Section& section) {
  const double strength = section.number(
      {"field_ut", "Strength of the earth's field at the place of the flight, from a model such as the WMM."},
      Limits::between(10, 100));
  const double inclination =
      section.number({"inclination_deg", "Its inclination, positive downwards."}, Limits::between(-90, 90));
  const double declination = section.number({"declination_deg", "Its declination, positive to the east."},
                                            Limits::between(-180, 180));
  return strength * Vector3(std::cos(inclination) * std::cos(declination),
                            std::cos(inclination) * std::sin(declination), std::sin(inclination));
}

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  MagnetometerSettings node;
  node.schedule = read_schedule(section);
  node.field_n = read_field(section);
  node.hard_iron = read_constants(section, "hard_iron_ut",
                                  "the field, from magnetised parts of the vehicle, body axes [x, y, z]");
  const Limits share = Limits::between(-100, 100);
  const Vector3 along = section.three(
      {"soft_iron_percent", "Change of the field along each body axis by magnetisable parts, [x, y, z]."},
      share);
  const Vector3 across =
      section.three({"soft_iron_cross_percent",
                     "Field along one axis by the field along another, [xy, xz, yz], both ways."},
                    share);
  node.soft_iron << along.x(), across.x(), across.y(), across.x(), along.y(), across.z(), across.y(),
      across.z(), along.z();
  node.mounting = read_mounting(section, "the magnetometer");
  node.scale_factor = read_constant(section, "scale_factor_ppm", "the scale of all axes");
  node.noise = section.three({"noise_ut", "White noise of the field, 1-sigma of a sample."}, sigma);
  node.further = read_error_stacks(section, {.of = "the field", .range = "range_ut", .step = "step_ut"});
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Magnetometer final : public LossySampler<MagnetometerSettings> {
 public:
  Magnetometer(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "magnetometer.loss"),
        stream_(run.stream("magnetometer")),
        hard_iron_(draw(config_.hard_iron, stream_)),
        scale_(1 + draw(config_.scale_factor, stream_)),
        further_(config_.further, 1e-6 * static_cast<double>(node.period_us()),
                 run.stream("magnetometer.further")) {
    world::Stream mounting = run.stream("magnetometer.mounting");
    const world::Matrix3 C_bs = world::mounted(draw(config_.mounting, mounting));
    to_own_ = C_bs * (world::Matrix3::Identity() + config_.soft_iron);
    hard_iron_ = C_bs * hard_iron_;
  }

 private:
  // The field of soft iron is in proportion to the earth's field in body axes; that of hard iron is constant
  // there.
  //
  // The magnetic heading of a compass with an ideal level: the measured field is turned by the true roll and
  // pitch, and the heading is the angle from it to the forward axis. It is the true heading less the
  // declination, and has the errors of the field. Groves (2013), eq. (6.6).
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const Vector3 earth = scale_ * (truth.C_bn.transpose() * config_.field_n);
    const Vector3 field = to_own_ * earth;
    const Vector3 m = further_.given(field + hard_iron_ + config_.noise.cwiseProduct(stream_.normal3()));
    world::Euler level = world::euler_from(truth.C_bn);
    level.heading = 0;
    const Vector3 levelled = world::C_bn_from(level) * m;
    sample.values = {m.x(), m.y(), m.z(), std::atan2(-levelled.y(), levelled.x())};
  }

  world::Stream stream_;
  Vector3 hard_iron_;  // the magnetometer's axes
  double scale_;
  world::TriadErrors further_;
  world::Matrix3 to_own_;  // from the earth's field in body axes to the field in the magnetometer's
};

}  // namespace

constinit const Kind magnetometer{.key = "magnetometer",
                                  .read = read,
                                  .make = make<Magnetometer>,
                                  .outputs = {.values = values},
                                  .period_us = usual_period_us};

}  // namespace canhil::sensors
