#include "bench/run/monitor.hpp"

#include <algorithm>

#include "bench/run/heard.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::run {
namespace {

using namespace messages;
using world::Vector3;
using world::units::deg;
using world::units::degph;
using world::units::ug;

// The groups of answers, and which of them each message belongs to.
enum class AnswerGroup : std::uint8_t { none, align_nav, align_filter, fix_nav, fix_filter, los_rate, wind };

constexpr AnswerGroup answer_group(const MessageInfo& info) {
  constexpr std::pair<std::string_view, AnswerGroup> groups[] = {
      {AlignVelocityD::info.sample_group, AnswerGroup::align_nav},
      {AlignUpdate::info.sample_group, AnswerGroup::align_filter},
      {FixVelocityD::info.sample_group, AnswerGroup::fix_nav},
      {FixUpdate::info.sample_group, AnswerGroup::fix_filter},
      {LosRateTarget::info.sample_group, AnswerGroup::los_rate},
      {WindUpdate::info.sample_group, AnswerGroup::wind}};
  for (const auto& [name, group] : groups) {
    if (info.sample_group == name) return group;
  }
  return AnswerGroup::none;
}

constexpr auto answer_groups = [] {
  std::array<AnswerGroup, all_messages.size()> groups{};
  std::ranges::transform(all_messages, groups.begin(), answer_group);
  return groups;
}();

constexpr bool is_answered(std::string_view group) {
  return std::ranges::any_of(all_messages, [&](const MessageInfo& info) {
    return std::ranges::find(info.answers, group) != info.answers.end();
  });
}

// The message that closes a sample group which the target answers.
template <class Message>
concept ClosesStimulus = requires(Message message) {
  message.time_of_validity_us;
}
&&is_answered(Message::info.sample_group);

// The sample group that a frame of the bench closes, and its time of validity.
struct Closed {
  std::string_view group;  // empty: none that is answered
  std::uint32_t valid_us = 0;
};

Closed closed_by(const Frame& frame) {
  Closed closed;
  const auto try_one = [&]<class Message>(std::type_identity<Message>) {
    if constexpr (ClosesStimulus<Message>) {
      if (frame.id == Message::info.id)
        closed = {Message::info.sample_group, from_frame<Message>(frame).time_of_validity_us};
    }
  };
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (try_one(std::type_identity<Messages>{}), ...);
  }(std::type_identity<AllMessages>{});
  return closed;
}

}  // namespace

void Monitor::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (!sent_any_) seen_.first_ns = t_ns;
  sent_any_ = true;
  seen_.last_ns = t_ns;
  if (stopwatch_) stopwatch_->sent(frame, t_ns, late_ns);
  if (frame.id == Sync::info.id) {
    now_us_ = static_cast<std::int64_t>(from_frame<Sync>(frame).time_us);
  } else if (const Closed closed = closed_by(frame); !closed.group.empty()) {
    const std::int64_t valid_us = unwrap_us(closed.valid_us, now_us_);
    seen_.stimuli[closed.group].add(valid_us);
    if (closed.group == SsblRelativeD::info.sample_group)
      seen_.sent_fixes.push_back({.source = FixSource::ssbl, .valid_us = valid_us});
    if (closed.group == GpsTime::info.sample_group)
      seen_.sent_fixes.push_back({.source = FixSource::gps, .valid_us = valid_us});
    if (stopwatch_)
      stopwatch_->stimulus(closed.group, {.valid_us = valid_us, .t_ns = t_ns, .due_ns = t_ns - late_ns});
  }
}

// The transmit stamp of a stimulus, once the bus has echoed it, replaces the bench's own.
void Monitor::echoed(const Received& received) {
  const Closed closed = closed_by(received.frame);
  if (!closed.group.empty()) seen_.transmit_stamps_echoed = true;
  if (stopwatch_) stopwatch_->echoed(received, closed.group, unwrap_us(closed.valid_us, now_us_));
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
  if (stopwatch_) stopwatch_->arrived(index, received);
  decode(frame, index);
}

void Monitor::decode(const Frame& frame, std::size_t index) {
  const std::uint8_t counter = e2e::counter(frame.payload());
  switch (answer_groups[index]) {
    case AnswerGroup::align_nav:
      if (put(navigation_, frame, counter)) on_navigation(navigation_, seen_.navigation);
      return;
    case AnswerGroup::fix_nav:
      if (put(fix_navigation_, frame, counter)) on_navigation(fix_navigation_, seen_.fix_navigation);
      return;
    case AnswerGroup::align_filter:
      if (put(filter_, frame, counter)) on_filter();
      return;
    case AnswerGroup::fix_filter:
      if (put(fix_, frame, counter)) on_fix();
      return;
    case AnswerGroup::los_rate:
      if (put(los_, frame, counter)) on_los();
      return;
    case AnswerGroup::wind:
      if (put(wind_, frame, counter)) on_wind();
      return;
    case AnswerGroup::none:
      break;
  }
  if (frame.id == TargetCounters::info.id) {
    seen_.counters = from_frame<TargetCounters>(frame);
  } else if (frame.id == TargetTiming::info.id) {
    const auto timing = from_frame<TargetTiming>(frame);
    seen_.target_timing_seen = true;
    seen_.queue_max_us = std::max(seen_.queue_max_us, timing.queue_max_us);
    seen_.compute_max_us = std::max(seen_.compute_max_us, timing.compute_max_us);
    if (stopwatch_) stopwatch_->told(timing);
  }
}

// Puts a frame into the group if it is one of its messages; true: the group is whole now.
template <class... Messages>
bool Monitor::put(SampleGroup<Messages...>& group, const Frame& frame, std::uint8_t counter) {
  bool complete = false;
  const auto try_one = [&]<class Message>(std::type_identity<Message>) {
    if (frame.id == Message::info.id)
      complete =
          group.put(from_frame<Message>(frame), counter) == SampleGroup<Messages...>::Outcome::complete;
  };
  (try_one(std::type_identity<Messages>{}), ...);
  return complete;
}

// The newest arrival of every message of a whole group is the answer to this.
template <class... Messages>
void Monitor::attribute(const SampleGroup<Messages...>& /*group*/, std::int64_t cause_us,
                        std::string_view cause_group) {
  constexpr std::array<std::size_t, sizeof...(Messages)> indices{message_index<Messages>()...};
  for (const std::size_t index : indices) ++seen_.answers[index];
  if (stopwatch_) stopwatch_->answered(indices, cause_group, cause_us);
}

template <class Attitude, class VelocityNE, class VelocityD>
void Monitor::on_navigation(const SampleGroup<Attitude, VelocityNE, VelocityD>& group,
                            std::vector<checks::NavigationAnswer>& answers) {
  const auto& attitude = group.template get<Attitude>();
  const auto& horizontal = group.template get<VelocityNE>();
  const auto& vertical = group.template get<VelocityD>();
  const std::int64_t cause_us = unwrap_us(vertical.cause_time_us, now_us_);
  answers.push_back(
      {.cause_us = cause_us,
       .angles = {attitude.roll_deg * deg, attitude.pitch_deg * deg, attitude.heading_deg * deg},
       .v_eb_n =
           Vector3(horizontal.velocity_north_mps, horizontal.velocity_east_mps, vertical.velocity_down_mps),
       .coasting = attitude.coasting != 0});
  attribute(group, cause_us, VelocityD::info.answers.front());
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
  attribute(filter_, cause_us, AlignUpdate::info.answers.front());
}

void Monitor::on_fix() {
  const auto& innovation = fix_.get<FixInnovation>();
  const auto& latitude = fix_.get<FixPositionLatitude>();
  const auto& attitude = fix_.get<FixAttitudeSigma>();
  const auto& velocity = fix_.get<FixVelocitySigma>();
  const auto& position = fix_.get<FixPositionSigma>();
  const auto& gyro = fix_.get<FixGyroBias>();
  const auto& accel = fix_.get<FixAccelBias>();
  const auto& bias = fix_.get<FixBias>();
  const auto& bias_sigma = fix_.get<FixBiasSigma>();
  const auto& status = fix_.get<FixStatus>();
  const auto& update = fix_.get<FixUpdate>();
  const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us_);
  seen_.fixes.push_back(
      {.cause_us = cause_us,
       .navigation_us = seen_.fix_navigation.empty() ? -1 : seen_.fix_navigation.back().cause_us,
       .source = status.source,
       .outcome = status.outcome,
       .nis = update.nis,
       .innovation = {innovation.innovation_north_m, innovation.innovation_east_m,
                      innovation.innovation_down_m},
       .position = {.latitude = latitude.latitude_deg * deg,
                    .longitude = fix_.get<FixPositionLongitude>().longitude_deg * deg,
                    .height = latitude.height_m},
       .tilt_sigma_north = attitude.tilt_sigma_north_deg * deg,
       .tilt_sigma_east = attitude.tilt_sigma_east_deg * deg,
       .heading_sigma = attitude.heading_sigma_deg * deg,
       .velocity_sigma = {velocity.velocity_sigma_north_mps, velocity.velocity_sigma_east_mps,
                          velocity.velocity_sigma_down_mps},
       .position_sigma = {position.position_sigma_north_m, position.position_sigma_east_m,
                          position.position_sigma_down_m},
       .gyro_bias = Vector3(gyro.gyro_bias_x_degph, gyro.gyro_bias_y_degph, gyro.gyro_bias_z_degph) * degph,
       .accel_bias = Vector3(accel.accel_bias_x_ug, accel.accel_bias_y_ug, accel.accel_bias_z_ug) * ug,
       .fix_bias = {bias.fix_bias_north_m, bias.fix_bias_east_m, bias.fix_bias_down_m},
       .fix_bias_sigma = {bias_sigma.fix_bias_sigma_north_m, bias_sigma.fix_bias_sigma_east_m,
                          bias_sigma.fix_bias_sigma_down_m},
       .handed_over = status.handed_over != 0,
       .repairs = status.repairs,
       .gated = status.gated,
       .refused = status.refused});
  attribute(fix_, cause_us,
            status.source == FixSource::gps ? GpsTime::info.sample_group : SsblRelativeD::info.sample_group);
}

void Monitor::on_wind() {
  const auto& wind = wind_.get<WindVector>();
  const auto& status = wind_.get<WindSpeed>();
  const auto& sigma = wind_.get<WindSigma>();
  const auto& correlation = wind_.get<WindCorrelation>();
  const auto& track = wind_.get<WindTrackSigma>();
  const auto& air = wind_.get<WindAirVelocity>();
  const auto& update = wind_.get<WindUpdate>();
  const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us_);
  const int outside = status.outside_alpha | status.outside_beta | status.outside_speed |
                      status.outside_mach | status.outside_altitude | status.outside_pitch;
  seen_.wind.push_back(
      {.cause_us = cause_us,
       .started = wind.started != 0,
       .outcome = status.outcome,
       .fault = status.fault,
       .outside = outside != 0,
       .fins_late = status.fins_late != 0,
       .fins_missing = status.fins_missing != 0,
       .fins_not_physical = status.fins_not_physical != 0,
       .theta_capped = status.theta_capped != 0,
       .wind_n = {wind.wind_north_mps, wind.wind_east_mps, wind.wind_down_mps},
       .sigma = {sigma.wind_sigma_north_mps, sigma.wind_sigma_east_mps, sigma.wind_sigma_down_mps},
       .correlation = {correlation.wind_correlation_ne, correlation.wind_correlation_nd,
                       correlation.wind_correlation_ed},
       .along_track_sigma = track.along_track_sigma_mps,
       .cross_track_sigma = track.cross_track_sigma_mps,
       .v_a = {air.air_velocity_x_mps, air.air_velocity_y_mps, air.air_velocity_z_mps},
       .nis = update.nis});
  attribute(wind_, cause_us, WindUpdate::info.answers.front());
}

void Monitor::on_los() {
  const auto& estimate = los_.get<LosRateEstimate>();
  const auto& sigma = los_.get<LosRateSigma>();
  const auto& target = los_.get<LosRateTarget>();
  const std::int64_t cause_us = unwrap_us(target.cause_time_us, now_us_);
  seen_.los.push_back(
      {.cause_us = cause_us,
       .outcome = estimate.outcome,
       .fault = estimate.fault,
       .blind = estimate.blind != 0,
       .rate = {.pitch = estimate.los_rate_pitch_radps, .yaw = estimate.los_rate_yaw_radps},
       .rate_sigma = {.pitch = sigma.los_rate_sigma_pitch_radps, .yaw = sigma.los_rate_sigma_yaw_radps},
       .target = {.pitch = target.target_acceleration_z_mps2, .yaw = target.target_acceleration_y_mps2},
       .target_sigma = {.pitch = sigma.target_acceleration_sigma_z_mps2,
                        .yaw = sigma.target_acceleration_sigma_y_mps2},
       .nis = sigma.nis});
  attribute(los_, cause_us, LosRateTarget::info.answers.front());
}

}  // namespace canhil::run
