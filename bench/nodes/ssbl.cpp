#include "bench/nodes/ssbl.hpp"

#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {

using messages::Validity;
using world::Vector3;
using world::units::deg;

Ssbl::Ssbl(const world::FlightRecord& flight, const scenario::Ssbl& config, world::Stream stream)
    : flight_(flight),
      config_(config),
      stream_(stream),
      ship_error_(draw(config.ship_error, stream_)),
      bias_(draw(config.bias, stream_)),
      sampling_(config.schedule.period_us.value_or(messages::SsblRelativeD::info.cycle_time_us),
                config.schedule.latency_us, flight.end_us()) {}

void Ssbl::transmit(Transmission& out) {
  const std::int64_t t_us = sampling_.valid_us();
  const Vector3 way = config_.ship_offset + 1e-6 * static_cast<double>(t_us) * config_.ship_velocity;
  const world::Position ship = displaced(flight_.epochs().front().position, way);
  const Vector3 relative = displacement_n(ship, flight_.at(t_us).position);

  // Angles have errors in proportion to the range: added as independent of the rest.
  const Vector3 range_noise = Vector3::Constant(config_.range_noise * relative.norm());
  const Vector3 sigma = (config_.noise.array().square() + range_noise.array().square()).sqrt();
  const Vector3 noise = sigma.cwiseProduct(stream_.normal3());
  const Fate fate = draw_fate(config_.faults, t_us, stream_);
  Vector3 measured = relative + bias_ + noise + fate.jump;
  if (fate.invalid) measured.setZero();  // nothing to be had from it
  const world::Position reported = displaced(ship, ship_error_);
  out.send(messages::SsblRelativeNE{.relative_north_m = measured.x(),
                                    .relative_east_m = measured.y(),
                                    .position_validity = fate.invalid ? Validity::invalid : Validity::valid});
  out.send(messages::SsblShipLatitude{.latitude_deg = reported.latitude / deg, .height_m = reported.height});
  out.send(messages::SsblShipLongitude{.longitude_deg = world::longitude_deg(reported),
                                       .relative_sigma_m = sigma.maxCoeff()});
  out.send(messages::SsblRelativeD{.relative_down_m = measured.z(), .time_of_validity_us = wrap_us(t_us)});
  if (fate.lost) out.clear();  // counted as sent: the receiver sees the gap
  sampling_.advance();
}

}  // namespace canhil::nodes
