#include "bench/sensors/gps.hpp"

#include <algorithm>
#include <array>

#include "bench/sensors/constant_error.hpp"
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
  node.bias = read_constants(section, "bias_m", "the position, [N, E, D]");
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
      : Sampler(node, run), stream_(run.stream("gps")), bias_(draw(config_.bias, stream_)) {}

 private:
  bool take(std::int64_t t_us, Sample& sample) override {
    const world::Position truth = run_.flight.at(t_us).position;
    const Vector3 noise = config_.noise.cwiseProduct(stream_.normal3());
    const Fate fate = draw_fate(config_.faults, t_us, stream_);
    const bool valid = !fate.invalid && !(config_.lowest_height && truth.height < *config_.lowest_height);
    const world::Position measured = valid ? displaced(truth, bias_ + noise + fate.jump)
                                           : world::Position{};  // an invalid fix has no position
    sample.values = {measured.latitude,
                     measured.height,
                     measured.longitude,
                     valid ? satellites : 0,
                     std::max(config_.noise.x(), config_.noise.y()),
                     config_.noise.z()};
    sample.invalid = valid ? 0 : 1;
    return !fate.lost;
  }

  world::Stream stream_;
  Vector3 bias_;
};

}  // namespace

constinit const Kind gps{.key = "gps",
                         .samples = scenario::TruthOf::navigation,
                         .read = read,
                         .make = make<Gps>,
                         .outputs = {.values = values, .flags = flags},
                         .aid = scenario::Aid{.aiding = 1, .lost = lost_fixes<GpsSettings>}};

}  // namespace canhil::sensors
