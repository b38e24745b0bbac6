#include "bench/sensors/gps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/error_stack.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr double satellites = 9;  // the error model has no satellites
constexpr std::array<Output, 6> values{{{"latitude", "rad"},
                                        {"height", "m"},
                                        {"longitude", "rad", true},
                                        {.name = "satellites", .assumed = satellites},
                                        {"horizontal_sigma", "m"},
                                        {"vertical_sigma", "m"}}};
constexpr std::array<std::string_view, 1> flags{"position"};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  GpsSettings node;
  node.schedule = read_schedule(section);
  node.lever_arm = read_lever_arm(section, "the antenna");
  node.bias = read_constants(section, "bias_m", "the position, [N, E, D]");
  node.further = read_error_stacks(
      section,
      {.of = "the position, [N, E, D]", .correlated = "correlated_m", .correlation = "correlation_s"});
  node.noise = section.three({"noise_m", "White noise of the position, 1-sigma of a fix."}, sigma);
  if (section.has("lowest_height_m"))
    node.lowest_height = section.number(
        {"lowest_height_m",
         "Height below which all fixes are invalid. Default: fixes are valid at every height."},
        Limits{});
  section.optional("lowest_height_m");
  node.faults = read_fix_faults(section);
  return {table, node};
}

class Gps final : public Sampler<GpsSettings> {
 public:
  Gps(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        stream_(run.stream("gps")),
        bias_(draw(config_.bias, stream_)),
        further_(config_.further, 1e-6 * static_cast<double>(node.period_us()), run.stream("gps.further")) {}

 private:
  bool take(std::int64_t t_us, Sample& sample) override {
    const world::Truth at = run_.flight.at(t_us);
    const world::Position truth = displaced(at.position, at.C_bn * config_.lever_arm);
    const Vector3 noise = config_.noise.cwiseProduct(stream_.normal3());
    const Vector3 correlated = further_.wander();
    const Fate fate = draw_fate(config_.faults, t_us, stream_);
    const bool valid = !fate.invalid && !(config_.lowest_height && truth.height < *config_.lowest_height);
    const world::Position measured = valid ? displaced(truth, bias_ + noise + fate.jump + correlated)
                                           : world::Position{};  // an invalid fix has no position
    const Vector3 sigma = config_.noise.binaryExpr(
        Vector3(config_.further[0].correlated, config_.further[1].correlated, config_.further[2].correlated),
        [](double white, double slow) { return std::hypot(white, slow); });
    sample.values = {measured.latitude,
                     measured.height,
                     measured.longitude,
                     valid ? satellites : 0,
                     std::max(sigma.x(), sigma.y()),
                     sigma.z()};
    sample.invalid = valid ? 0 : 1;
    return !fate.lost;
  }

  world::Stream stream_;
  Vector3 bias_;
  world::TriadErrors further_;
};

}  // namespace

constinit const Kind gps{.key = "gps",
                         .read = read,
                         .make = make<Gps>,
                         .outputs = {.values = values, .flags = flags},
                         .aid = scenario::Aid{.aiding = 1, .lost = lost_fixes<GpsSettings>}};

}  // namespace canhil::sensors
