#include "bench/nodes/gps.hpp"

#include <algorithm>

#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::Validity;
using world::Vector3;
using world::units::deg;

constexpr std::uint8_t satellites = 9;  // the error model knows no constellation

}  // namespace

Gps::Gps(const world::FlightRecord& flight, const scenario::Gps& config, world::Stream stream)
    : flight_(flight),
      config_(config),
      stream_(stream),
      bias_(draw(config.bias, stream_)),
      sampling_(config.schedule.period_us.value_or(messages::GpsTime::info.cycle_time_us),
                config.schedule.latency_us, flight.end_us()) {}

void Gps::transmit(Transmission& out) {
  const std::int64_t t_us = sampling_.valid_us();
  const world::Position truth = flight_.at(t_us).position;
  const Vector3 noise = config_.noise.cwiseProduct(stream_.normal3());
  const Fate fate = draw_fate(config_.faults, t_us, stream_);
  const bool valid = !fate.invalid && !(config_.lowest_height && truth.height < *config_.lowest_height);
  const world::Position measured =
      valid ? displaced(truth, bias_ + noise + fate.jump) : world::Position{};  // nothing to be had from it
  out.send(messages::GpsLatitude{.latitude_deg = measured.latitude / deg, .height_m = measured.height});
  out.send(messages::GpsLongitude{.longitude_deg = world::longitude_deg(measured),
                                  .satellites = valid ? satellites : std::uint8_t{0},
                                  .position_validity = valid ? Validity::valid : Validity::invalid});
  out.send(messages::GpsTime{.horizontal_sigma_m = std::max(config_.noise.x(), config_.noise.y()),
                             .vertical_sigma_m = config_.noise.z(),
                             .time_of_validity_us = wrap_us(t_us)});
  if (fate.lost) out.clear();  // counted as sent: the receiver sees the gap
  sampling_.advance();
}

}  // namespace canhil::nodes
