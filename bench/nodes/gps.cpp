#include "bench/nodes/gps.hpp"

#include <algorithm>
#include <array>

#include "bench/nodes/sampler.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::Validity;
using world::Vector3;
using world::units::deg;

constexpr std::uint8_t satellites = 9;  // the error model has no satellites
constexpr std::array<scenario::Assumed, 1> assumed{{{"satellites", satellites}}};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  GpsSettings node;
  node.schedule = read_schedule(section);
  node.bias = {
      .value = section.three({"bias_m", "Constant error of the position, [N, E, D]."}),
      .sigma = section.three(
          {"bias_sigma_m",
           "1-sigma of a further constant error. This error is drawn for each run and added to `bias_m`."},
          sigma)};
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
  bool sample(std::int64_t t_us, Transmission& out) override {
    const world::Position truth = run_.flight.at(t_us).position;
    const Vector3 noise = config_.noise.cwiseProduct(stream_.normal3());
    const Fate fate = draw_fate(config_.faults, t_us, stream_);
    const bool valid = !fate.invalid && !(config_.lowest_height && truth.height < *config_.lowest_height);
    const world::Position measured = valid ? displaced(truth, bias_ + noise + fate.jump)
                                           : world::Position{};  // an invalid fix has no position
    out.send(messages::GpsLatitude{.latitude_deg = measured.latitude / deg, .height_m = measured.height});
    out.send(messages::GpsLongitude{.longitude_deg = world::longitude_deg(measured),
                                    .satellites = valid ? satellites : std::uint8_t{0},
                                    .position_validity = valid ? Validity::valid : Validity::invalid});
    out.send(messages::GpsTime{.horizontal_sigma_m = std::max(config_.noise.x(), config_.noise.y()),
                               .vertical_sigma_m = config_.noise.z(),
                               .time_of_validity_us = wrap_us(t_us)});
    return !fate.lost;
  }

  world::Stream stream_;
  Vector3 bias_;
};

}  // namespace

constinit const Kind gps{.table = {.key = "gps",
                                   .closes = messages::GpsTime::info,
                                   .samples = scenario::TruthOf::navigation,
                                   .read = read,
                                   .aid = scenario::Aid{.aiding = 1, .lost = lost_fixes<GpsSettings>},
                                   .assumed = assumed},
                         .make = make<Gps>};

}  // namespace canhil::nodes
