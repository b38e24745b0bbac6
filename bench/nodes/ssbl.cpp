#include "bench/nodes/ssbl.hpp"

#include "bench/nodes/sampler.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::Validity;
using world::Vector3;
using world::units::deg;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  SsblSettings node;
  node.schedule = read_schedule(section);
  node.ship_offset = section.three(
      {"ship_offset_m", "Position of the ship relative to the vehicle at the start, [N, E, D]."},
      Limits::between(-5'000, 5'000));
  node.ship_velocity =
      section.three({"ship_velocity_mps", "Velocity of the ship, [N, E, D]."}, Limits::between(-50, 50));
  node.ship_error = {
      .value = section.three(
          {"ship_error_m", "Constant error of the ship's own position, as the ship reports it."}),
      .sigma = section.three({"ship_error_sigma_m",
                              "1-sigma of a further constant error. This error is drawn for each run and "
                              "added to `ship_error_m`."},
                             sigma)};
  node.bias = {
      .value = section.three({"bias_m", "Constant error of the vehicle's position relative to the ship."}),
      .sigma = section.three(
          {"bias_sigma_m",
           "1-sigma of a further constant error. This error is drawn for each run and added to `bias_m`."},
          sigma)};
  node.noise = section.three(
      {"noise_m", "White noise of the vehicle's position relative to the ship, 1-sigma of a fix."}, sigma);
  node.range_noise = section.number(
      {"range_noise_percent", "White noise in proportion to the slant range, 1-sigma of a fix."},
      Limits::between(0, 100), 0);
  node.faults = read_fix_faults(section);
  return {table, node};
}

class Ssbl final : public Sampler<SsblSettings> {
 public:
  Ssbl(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        stream_(run.stream("ssbl")),
        ship_error_(draw(config_.ship_error, stream_)),
        bias_(draw(config_.bias, stream_)) {}

 private:
  bool sample(std::int64_t t_us, Transmission& out) override {
    const Vector3 way = config_.ship_offset + 1e-6 * static_cast<double>(t_us) * config_.ship_velocity;
    const world::Position ship = displaced(run_.flight.epochs().front().position, way);
    const Vector3 relative = displacement_n(ship, run_.flight.at(t_us).position);

    // Angle errors cause position errors that are proportional to the range. Here they are added as an
    // independent error of each component.
    const Vector3 range_noise = Vector3::Constant(config_.range_noise * relative.norm());
    const Vector3 sigma = (config_.noise.array().square() + range_noise.array().square()).sqrt();
    const Vector3 noise = sigma.cwiseProduct(stream_.normal3());
    const Fate fate = draw_fate(config_.faults, t_us, stream_);
    Vector3 measured = relative + bias_ + noise + fate.jump;
    if (fate.invalid) measured.setZero();  // an invalid fix has no position
    const world::Position reported = displaced(ship, ship_error_);
    out.send(
        messages::SsblRelativeNE{.relative_north_m = measured.x(),
                                 .relative_east_m = measured.y(),
                                 .position_validity = fate.invalid ? Validity::invalid : Validity::valid});
    out.send(
        messages::SsblShipLatitude{.latitude_deg = reported.latitude / deg, .height_m = reported.height});
    out.send(messages::SsblShipLongitude{.longitude_deg = world::longitude_deg(reported),
                                         .relative_sigma_m = sigma.maxCoeff()});
    out.send(messages::SsblRelativeD{.relative_down_m = measured.z(), .time_of_validity_us = wrap_us(t_us)});
    return !fate.lost;
  }

  world::Stream stream_;
  Vector3 ship_error_;
  Vector3 bias_;
};

}  // namespace

constinit const Kind ssbl{.table = {.key = "ssbl",
                                    .closes = messages::SsblRelativeD::info,
                                    .samples = scenario::TruthOf::navigation,
                                    .read = read,
                                    .aid = scenario::Aid{.aiding = 0, .lost = lost_fixes<SsblSettings>}},
                          .make = make<Ssbl>};

}  // namespace canhil::nodes
