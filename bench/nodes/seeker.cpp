#include "bench/nodes/seeker.hpp"

#include "bench/nodes/is_whole.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using namespace messages;

constexpr Validity validity(bool valid) { return valid ? Validity::valid : Validity::invalid; }

constexpr bool is_estimate(LosRateOutcome outcome) {
  return outcome == LosRateOutcome::started || outcome == LosRateOutcome::start_up ||
         outcome == LosRateOutcome::updated || outcome == LosRateOutcome::coasting;
}

}  // namespace

Seeker::Seeker(const world::EngagementPlan& plan, const scenario::Seeker& config,
               const SeekerStreams& streams, std::int64_t end_us, world::EngagementRecord& record)
    : engagement_(plan, streams.engagement),
      errors_(config.errors, streams.errors),
      config_(config),
      faults_(streams.faults),
      guided_(plan.guidance == world::Guidance::target),
      guidance_delay_us_(plan.guidance_delay_us),
      period_us_(config.schedule.period_us.value_or(SeekerRange::info.cycle_time_us)),
      end_us_(end_us),
      record_(record),
      valid_us_(0),
      rounding_(SeekerAntenna::signals()[0]) {
  advance();
}

std::int64_t Seeker::due_us() const { return engagement_.over() || due_us_ > end_us_ ? never_us : due_us_; }

// Sent in the order of sampling, whatever the jitter is.
void Seeker::advance() {
  valid_us_ += period_us_;
  const double jitter_us = faults_.uniform() * static_cast<double>(config_.jitter_us);
  due_us_ = std::max(due_us_, valid_us_ + config_.schedule.latency_us + static_cast<std::int64_t>(jitter_us));
}

void Seeker::transmit(Transmission& out) {
  engagement_.fly_to(valid_us_);
  const world::SeekerIncrement increment = engagement_.take_increment();
  if (engagement_.over()) {
    record_.miss_n = engagement_.miss_n();
    record_.passage_us = engagement_.t_us();
    return;
  }
  const world::EngagementTruth now = engagement_.truth();
  record_.epochs.push_back(now);
  const world::SeekerMeasurement measured = errors_.measure(now, increment);
  send(out, measured);
  if (guided_) {
    sent_.push_back({.valid_us = valid_us_,
                     .sent_us = due_us_,
                     .C_na = now.C_na,
                     .closing_speed = measured.closing_speed});
  }
  advance();
}

void Seeker::send(Transmission& out, const world::SeekerMeasurement& measured) {
  const bool lost = faults_.uniform() < config_.loss_probability;
  const bool invalid = faults_.uniform() < config_.invalid_probability;
  const bool range_invalid = faults_.uniform() < config_.invalid_range_probability;
  const auto& blackout = config_.blackout_us;
  const bool black = blackout && measured.t_us >= blackout->first && measured.t_us <= blackout->second;
  const bool seen = measured.in_view && !invalid && !black;
  const world::Vector3 antenna = rounding_.round(measured.antenna, out.rounding());
  out.send(SeekerAntenna{.antenna_increment_roll_rad = antenna.x(),
                         .antenna_increment_pitch_rad = antenna.y(),
                         .antenna_increment_yaw_rad = antenna.z(),
                         .antenna_validity = Validity::valid});
  out.send(SeekerAngles{.error_pitch_rad = seen ? measured.error.pitch : 0,  // nothing to be had from it
                        .error_yaw_rad = seen ? measured.error.yaw : 0,
                        .interval_us = static_cast<double>(measured.interval_us),
                        .error_validity = validity(seen)});
  out.send(SeekerMotion{.missile_acceleration_y_mps2 = measured.missile_acceleration.yaw,
                        .missile_acceleration_z_mps2 = measured.missile_acceleration.pitch,
                        .closing_speed_mps = range_invalid ? 0 : measured.closing_speed,
                        .acceleration_validity = Validity::valid,
                        .closing_speed_validity = validity(!range_invalid)});
  out.send(SeekerRange{.range_m = range_invalid ? 0 : measured.range,
                       .time_of_validity_us = wrap_us(measured.t_us),
                       .range_validity = validity(!range_invalid)});
  if (lost) out.clear();  // counted as sent: the receiver sees the gap
}

void Seeker::hear(const Frame& frame) {
  const auto put = [&]<class Message>(std::type_identity<Message>) {
    if (is_whole<Message>(frame) && answer_.put(from_frame<Message>(frame), e2e::counter(frame.payload())) ==
                                        decltype(answer_)::Outcome::complete) {
      steer();
    }
  };
  put(std::type_identity<LosRateEstimate>{});
  put(std::type_identity<LosRateSigma>{});
  put(std::type_identity<LosRateTarget>{});
}

// The answer in the antenna's axes of its sample, with the closing speed of that sample.
void Seeker::steer() {
  const auto& estimate = answer_.get<LosRateEstimate>();
  const std::int64_t cause_us = unwrap_us(answer_.get<LosRateTarget>().cause_time_us, valid_us_);
  while (!sent_.empty() && sent_.front().valid_us < cause_us) sent_.pop_front();
  if (sent_.empty() || sent_.front().valid_us != cause_us) return;
  if (!is_estimate(estimate.outcome) || estimate.blind != 0) return;  // guidance holds its command
  const Sent& sample = sent_.front();
  const world::Vector3 omega_los_a(0, estimate.los_rate_pitch_radps, estimate.los_rate_yaw_radps);
  const bool in_time = engagement_.command(sample.sent_us + guidance_delay_us_, sample.C_na * omega_los_a,
                                           sample.closing_speed);
  if (!in_time) ++record_.late_commands;
}

}  // namespace canhil::nodes
