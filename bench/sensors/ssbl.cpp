#include "bench/sensors/ssbl.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/error_stack.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr std::array<Output, 7> values{{{"relative_north", "m"},
                                        {"relative_east", "m"},
                                        {"latitude", "rad"},
                                        {"height", "m"},
                                        {"longitude", "rad", true},
                                        {"relative_sigma", "m"},
                                        {"relative_down", "m"}}};
constexpr std::array<std::string_view, 1> flags{"position"};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  SsblSettings node;
  node.schedule = read_schedule(section);
  node.ship_offset = section.three(
      {"ship_offset_m", "Position of the ship relative to the vehicle at the start, [N, E, D]."},
      Limits::between(-5'000, 5'000));
  node.ship_velocity =
      section.three({"ship_velocity_mps", "Velocity of the ship, [N, E, D]."}, Limits::between(-50, 50));
  node.ship_error =
      read_constants(section, "ship_error_m", "the ship's own position, as the ship reports it");
  node.bias = read_constants(section, "bias_m", "the vehicle's position relative to the ship");
  node.noise = section.three(
      {"noise_m", "White noise of the vehicle's position relative to the ship, 1-sigma of a fix."}, sigma);
  node.range_noise = section.number(
      {"range_noise_percent", "White noise in proportion to the slant range, 1-sigma of a fix."},
      Limits::between(0, 100), 0);
  node.further = read_error_stacks(section, {.of = "the vehicle's position relative to the ship, [N, E, D]",
                                             .correlated = "correlated_m",
                                             .correlation = "correlation_s"});
  node.faults = read_fix_faults(section);
  return {table, node};
}

class Ssbl final : public Sampler<SsblSettings> {
 public:
  Ssbl(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        stream_(run.stream("ssbl")),
        ship_error_(draw(config_.ship_error, stream_)),
        bias_(draw(config_.bias, stream_)),
        further_(config_.further, 1e-6 * static_cast<double>(node.period_us()), run.stream("ssbl.further")) {}

 private:
  bool take(std::int64_t t_us, Sample& sample) override {
    const Vector3 way = config_.ship_offset + 1e-6 * static_cast<double>(t_us) * config_.ship_velocity;
    const world::Position ship = displaced(run_.flight.epochs().front().position, way);
    const Vector3 relative = displacement_n(ship, run_.flight.at(t_us).position);

    // Angle errors cause position errors that are proportional to the range. Here they are added as an
    // independent error of each component.
    const Vector3 range_noise = Vector3::Constant(config_.range_noise * relative.norm());
    const Vector3 sigma = (config_.noise.array().square() + range_noise.array().square()).sqrt();
    const Vector3 noise = sigma.cwiseProduct(stream_.normal3());
    const Fate fate = draw_fate(config_.faults, t_us, stream_);
    Vector3 measured = relative + bias_ + noise + fate.jump + further_.wander();
    if (fate.invalid) measured.setZero();  // an invalid fix has no position
    const world::Position reported = displaced(ship, ship_error_);
    sample.values = {measured.x(),       measured.y(),          reported.latitude, reported.height,
                     reported.longitude, reported_sigma(sigma), measured.z()};
    sample.invalid = fate.invalid ? 1 : 0;
    return !fate.lost;
  }

  // The 1-sigma of the white noise and of the correlated error, of the worst axis.
  [[nodiscard]] double reported_sigma(const Vector3& white) const {
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest,
                         std::hypot(white(axis), config_.further[static_cast<std::size_t>(axis)].correlated));
    return largest;
  }

  world::Stream stream_;
  Vector3 ship_error_;
  Vector3 bias_;
  world::TriadErrors further_;
};

}  // namespace

constinit const Kind ssbl{.key = "ssbl",
                          .read = read,
                          .make = make<Ssbl>,
                          .outputs = {.values = values, .flags = flags},
                          .aid = scenario::Aid{.aiding = 0, .lost = lost_fixes<SsblSettings>}};

}  // namespace canhil::sensors
