#include "bench/run/monitor.hpp"

#include <algorithm>

#include "bench/world/units.hpp"
#include "dbc/wire/routes.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::run {
namespace {

using namespace messages;
using world::Vector3;
using world::units::deg;
using world::units::degph;
using world::units::ug;

constexpr Routes target_messages([](const MessageInfo& info) {
  return info.sender == TargetHeartbeat::info.sender;
});

// The transmit stamp of a stimulus, once the bus has echoed it, replaces the bench's own.
void restamp(std::vector<checks::Stimulus>& stimuli, std::int64_t valid_us, std::int64_t t_ns) {
  const auto found = std::find_if(stimuli.rbegin(), stimuli.rend(), [&](const checks::Stimulus& stimulus) {
    return stimulus.valid_us == valid_us;
  });
  if (found != stimuli.rend()) found->t_ns = t_ns;
}

}  // namespace

void Monitor::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (seen_.lateness_ns.empty()) seen_.first_ns = t_ns;
  seen_.last_ns = t_ns;
  seen_.lateness_ns.push_back(late_ns);
  if (frame.id == Sync::info.id) {
    now_us_ = static_cast<std::int64_t>(from_frame<Sync>(frame).time_us);
  } else if (frame.id == SlaveImuStatus::info.id) {
    seen_.slave_imu.push_back(
        {unwrap_us(from_frame<SlaveImuStatus>(frame).time_of_validity_us, now_us_), t_ns});
  } else if (frame.id == MasterInsVelocityD::info.id) {
    seen_.master_ins.push_back(
        {unwrap_us(from_frame<MasterInsVelocityD>(frame).time_of_validity_us, now_us_), t_ns});
  }
}

void Monitor::echoed(const Received& received) {
  const Frame& frame = received.frame;
  if (frame.id == SlaveImuStatus::info.id) {
    seen_.transmit_stamps_echoed = true;
    restamp(seen_.slave_imu, unwrap_us(from_frame<SlaveImuStatus>(frame).time_of_validity_us, now_us_),
            received.t_ns);
  } else if (frame.id == MasterInsVelocityD::info.id) {
    restamp(seen_.master_ins, unwrap_us(from_frame<MasterInsVelocityD>(frame).time_of_validity_us, now_us_),
            received.t_ns);
  }
}

void Monitor::received(const Received& received) {
  if (received.own) return echoed(received);
  const Frame& frame = received.frame;
  const std::size_t index = target_messages(frame);
  if (index == Routes::nowhere) return;
  const MessageInfo* info = &all_messages[index];
  if (frame.size != info->size || frame.fd != info->fd) {
    ++seen_.target_bad_crc;
    return;
  }
  switch (receivers_[index].check(frame.payload(), info->e2e_data_id)) {
    case e2e::Check::wrong_crc:
      ++seen_.target_bad_crc;
      return;
    case e2e::Check::repeated:
      return;
    case e2e::Check::some_lost:
      seen_.target_frames_lost += static_cast<std::uint32_t>(receivers_[index].lost());
      break;
    case e2e::Check::ok:
      break;
  }
  seen_.arrivals[index].push_back({.t_ns = received.t_ns});
  decode(frame, e2e::counter(frame.payload()));
}

void Monitor::decode(const Frame& frame, std::uint8_t counter) {
  switch (frame.id) {
    case AlignAttitude::info.id:
      return put_navigation<AlignAttitude>(frame, counter);
    case AlignVelocityNE::info.id:
      return put_navigation<AlignVelocityNE>(frame, counter);
    case AlignVelocityD::info.id:
      return put_navigation<AlignVelocityD>(frame, counter);
    case AlignInnovation::info.id:
      return put_filter<AlignInnovation>(frame, counter);
    case AlignAttitudeSigma::info.id:
      return put_filter<AlignAttitudeSigma>(frame, counter);
    case AlignAttitudeCorrelation::info.id:
      return put_filter<AlignAttitudeCorrelation>(frame, counter);
    case AlignVelocitySigma::info.id:
      return put_filter<AlignVelocitySigma>(frame, counter);
    case AlignGyroBias::info.id:
      return put_filter<AlignGyroBias>(frame, counter);
    case AlignGyroBiasSigma::info.id:
      return put_filter<AlignGyroBiasSigma>(frame, counter);
    case AlignAccelBias::info.id:
      return put_filter<AlignAccelBias>(frame, counter);
    case AlignAccelBiasSigma::info.id:
      return put_filter<AlignAccelBiasSigma>(frame, counter);
    case AlignUpdate::info.id:
      return put_filter<AlignUpdate>(frame, counter);
    case TargetHeartbeat::info.id:
      seen_.heartbeat = from_frame<TargetHeartbeat>(frame);
      return;
    case TargetCounters::info.id:
      seen_.counters = from_frame<TargetCounters>(frame);
      return;
    case TargetTiming::info.id: {
      const auto timing = from_frame<TargetTiming>(frame);
      seen_.target_timing_seen = true;
      seen_.queue_max_us = std::max(seen_.queue_max_us, timing.queue_max_us);
      seen_.compute_max_us = std::max(seen_.compute_max_us, timing.compute_max_us);
      return;
    }
    default:
      return;
  }
}

template <class Message>
void Monitor::put_navigation(const Frame& frame, std::uint8_t counter) {
  using Group = decltype(navigation_);
  if (navigation_.put(from_frame<Message>(frame), counter) == Group::Outcome::complete) on_navigation();
}

template <class Message>
void Monitor::put_filter(const Frame& frame, std::uint8_t counter) {
  using Group = decltype(filter_);
  if (filter_.put(from_frame<Message>(frame), counter) == Group::Outcome::complete) on_filter();
}

// Gives the newest arrival of every message of a whole group its cause.
template <class... Messages>
void Monitor::attribute(std::int64_t cause_us) {
  ((seen_.arrivals[message_index<Messages>()].back().cause_us = cause_us), ...);
}

void Monitor::on_navigation() {
  const auto& attitude = navigation_.get<AlignAttitude>();
  const auto& horizontal = navigation_.get<AlignVelocityNE>();
  const auto& vertical = navigation_.get<AlignVelocityD>();
  const std::int64_t cause_us = unwrap_us(vertical.cause_time_us, now_us_);
  seen_.navigation.push_back(
      {.cause_us = cause_us,
       .angles = {attitude.roll_deg * deg, attitude.pitch_deg * deg, attitude.heading_deg * deg},
       .v_eb_n =
           Vector3(horizontal.velocity_north_mps, horizontal.velocity_east_mps, vertical.velocity_down_mps),
       .coasting = attitude.coasting != 0});
  attribute<AlignAttitude, AlignVelocityNE, AlignVelocityD>(cause_us);
}

void Monitor::on_filter() {
  const auto& innovation = filter_.get<AlignInnovation>();
  const auto& sigma = filter_.get<AlignAttitudeSigma>();
  const auto& correlation = filter_.get<AlignAttitudeCorrelation>();
  const auto& velocity = filter_.get<AlignVelocitySigma>();
  const auto& gyro = filter_.get<AlignGyroBias>();
  const auto& accel = filter_.get<AlignAccelBias>();
  const auto& update = filter_.get<AlignUpdate>();
  const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us_);
  seen_.filter.push_back(
      {.cause_us = cause_us,
       .navigation_us = seen_.navigation.empty() ? -1 : seen_.navigation.back().cause_us,
       .nis = update.nis,
       .innovation = {innovation.innovation_north_mps, innovation.innovation_east_mps,
                      innovation.innovation_down_mps},
       .attitude_sigma = {sigma.attitude_sigma_north_rad, sigma.attitude_sigma_east_rad,
                          sigma.attitude_sigma_down_rad},
       .attitude_correlation = {correlation.attitude_correlation_ne, correlation.attitude_correlation_nd,
                                correlation.attitude_correlation_ed},
       .velocity_sigma = {velocity.velocity_sigma_north_mps, velocity.velocity_sigma_east_mps,
                          velocity.velocity_sigma_down_mps},
       .gyro_bias = Vector3(gyro.gyro_bias_x_degph, gyro.gyro_bias_y_degph, gyro.gyro_bias_z_degph) * degph,
       .accel_bias = Vector3(accel.accel_bias_x_ug, accel.accel_bias_y_ug, accel.accel_bias_z_ug) * ug});
  attribute<AlignInnovation, AlignAttitudeSigma, AlignAttitudeCorrelation, AlignVelocitySigma, AlignGyroBias,
            AlignGyroBiasSigma, AlignAccelBias, AlignAccelBiasSigma, AlignUpdate>(cause_us);
}

}  // namespace canhil::run
