#include "bench/nodes/fins.hpp"

#include "bench/nodes/sample_loss.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {

using messages::FinDeflections;
using world::units::deg;

Fins::Fins(const world::GlideRecord& glide, const scenario::Fins& config, world::Stream losses,
           std::int64_t end_us)
    : glide_(glide),
      config_(config),
      losses_(losses),
      sampling_(config.schedule.period_us.value_or(FinDeflections::info.cycle_time_us),
                config.schedule.latency_us, end_us) {}

void Fins::transmit(Transmission& out) {
  const std::int64_t t_us = sampling_.valid_us();
  const world::glide::Fins& fins = glide_.at(t_us).fins;
  const std::int64_t stamp_us = wrap_short_us(t_us + config_.stamp_error_us);
  out.send(FinDeflections{.elevator_deg = fins.x() / deg,
                          .aileron_deg = fins.y() / deg,
                          .rudder_deg = fins.z() / deg,
                          .time_of_validity_us = static_cast<double>(stamp_us)});
  if (is_lost(config_.loss, t_us, losses_)) out.clear();  // counted as sent: the receiver sees the gap
  sampling_.advance();
}

}  // namespace canhil::nodes
