#include "target/device/device.hpp"

#include <algorithm>
#include <numbers>

#include "dbc/wire/routes.hpp"
#include "target/device/adapters.hpp"
#include "target/device/version.hpp"

namespace canhil::target {
namespace {

using namespace messages;

constexpr std::int64_t heartbeat_period_us = TargetHeartbeat::info.cycle_time_us;
constexpr double radians = std::numbers::pi / 180.0;
// The bench's messages; the target's own are not for it.
constexpr Routes routes([](const MessageInfo& info) { return info.sender != TargetHeartbeat::info.sender; });

constexpr std::uint16_t saturated(std::uint32_t count) {
  return static_cast<std::uint16_t>(std::min(count, 8191U));
}

}  // namespace

Device::Device() : adapters_(make_adapters()) {}

std::span<const Frame> Device::receive(const Frame& frame) {
  answers_.clear();
  const std::size_t route = routes(frame);
  if (route == Routes::nowhere) return {};
  const MessageInfo& info = all_messages[route];
  if (frame.size != info.size || frame.fd != info.fd) {
    ++losses_.bad_crc;
    errors_.input_lost = true;
    return {};
  }
  e2e::Receiver& receiver = receivers_[route];
  switch (receiver.check(frame.payload(), info.e2e_data_id)) {
    case e2e::Check::wrong_crc:
      ++losses_.bad_crc;
      errors_.input_lost = true;
      return {};
    case e2e::Check::repeated:
      // A bench that starts anew may repeat the counter of the last one's command: commands are always heard.
      if (frame.id != TargetCommand::info.id) {
        ++losses_.late;
        return {};
      }
      break;
    case e2e::Check::some_lost:
      losses_.frames_lost += static_cast<std::uint32_t>(receiver.lost());
      errors_.input_lost = true;
      break;
    case e2e::Check::ok:
      break;
  }
  dispatch(frame, e2e::counter(frame.payload()));
  return answers_.frames();
}

void Device::dispatch(const Frame& frame, std::uint8_t counter) {
  switch (frame.id) {
    case Sync::info.id:
      return on_sync(from_frame<Sync>(frame));
    case TargetCommand::info.id:
      return on_command(from_frame<TargetCommand>(frame));
    case ParamSet::info.id:
      return on_parameter(from_frame<ParamSet>(frame));
    case TargetInitLatitude::info.id:
      return on_initial<TargetInitLatitude>(frame, counter);
    case TargetInitLongitude::info.id:
      return on_initial<TargetInitLongitude>(frame, counter);
    case TargetInitVelocityNE::info.id:
      return on_initial<TargetInitVelocityNE>(frame, counter);
    case TargetInitVelocityD::info.id:
      return on_initial<TargetInitVelocityD>(frame, counter);
    case TargetInitAttitude::info.id:
      return on_initial<TargetInitAttitude>(frame, counter);
    case TargetInitSigma::info.id:
      return on_initial<TargetInitSigma>(frame, counter);
    case TargetInitRate::info.id:
      return on_initial_air<TargetInitRate>(frame, counter);
    case TargetInitAirVelocity::info.id:
      return on_initial_air<TargetInitAirVelocity>(frame, counter);
    default:
      if (state_ != TargetState::running) return;
      untouched_ = false;
      apply(adapter_->receive(frame, counter, context()));
  }
}

void Device::on_sync(const Sync& sync) {
  untouched_ = false;
  now_us_ = static_cast<std::int64_t>(sync.time_us);
  lockstep_ = sync.lockstep != 0;
  if (state_ == TargetState::running) apply(adapter_->tick(context()));
  if (now_us_ >= heartbeat_due_us_) {
    heartbeat_due_us_ = (now_us_ / heartbeat_period_us + 1) * heartbeat_period_us;
    send_heartbeat();
    send_counters();
  }
  if (lockstep_) answers_.send(StepDone{.step = sync.step});
}

void Device::on_command(const TargetCommand& command) {
  if (command.dbc_hash != dbc_hash24) {
    errors_.dbc_mismatch = true;
    return send_heartbeat();
  }
  switch (command.command) {
    case Command::reset:
      return reset(command.estimator, command.algorithm);
    case Command::start:
      return start();
    case Command::stop:
      return enter(state_ == TargetState::running ? TargetState::idle : state_);
    case Command::none:
      break;
  }
  send_heartbeat();
}

void Device::reset(Estimator estimator, Algorithm algorithm) {
  receivers_ = {};
  answers_.reset_counters();
  losses_ = {};
  errors_ = {};
  initial_group_.discard();
  initial_air_group_.discard();
  initial_air_.reset();
  now_us_ = 0;
  heartbeat_due_us_ = 0;
  lockstep_ = false;
  algorithm_ = algorithm;
  const auto found =
      std::ranges::find_if(adapters_, [&](const auto& adapter) { return adapter->estimator() == estimator; });
  adapter_ = found == adapters_.end() ? nullptr : found->get();
  if (adapter_ != nullptr && !adapter_->reset(algorithm)) adapter_ = nullptr;
  errors_.command = adapter_ == nullptr;
  enter(TargetState::idle);
}

void Device::start() {
  // A bench that did not hear the answer in time commands it again.
  const bool again = state_ == TargetState::running && untouched_;
  if (state_ == TargetState::ready || again) {
    untouched_ = true;
    initial_.air = initial_air_;
    adapter_->start(initial_);
    answers_.reset_counters();  // what follows depends on this run's frames alone, not on how often a command
                                // was repeated
    return enter(TargetState::running);
  }
  if (state_ == TargetState::idle) {
    errors_.not_initialised = true;
  } else {
    errors_.command = true;
  }
  send_heartbeat();
}

void Device::on_parameter(const ParamSet& request) {
  ParamAck ack{.parameter = request.parameter, .value = request.value, .status = ParameterStatus::unknown};
  if (adapter_ != nullptr) {
    ack.status = adapter_->set(request.parameter, request.value, state_ == TargetState::running);
    ack.value = static_cast<float>(adapter_->get(request.parameter).value_or(request.value));
  }
  answers_.send(ack);
}

template <class Message>
void Device::on_initial(const Frame& frame, std::uint8_t counter) {
  if (state_ == TargetState::running) {
    errors_.command = true;
    return;
  }
  const auto outcome = initial_group_.put(from_frame<Message>(frame), counter);
  if (outcome == InitialGroup::Outcome::dropped_previous) ++losses_.bad_group;
  if (outcome == InitialGroup::Outcome::complete) on_initial_state();
}

void Device::on_initial_state() {
  const auto& latitude = initial_group_.get<TargetInitLatitude>();
  const auto& longitude = initial_group_.get<TargetInitLongitude>();
  const auto& horizontal = initial_group_.get<TargetInitVelocityNE>();
  const auto& vertical = initial_group_.get<TargetInitVelocityD>();
  const auto& attitude = initial_group_.get<TargetInitAttitude>();
  const auto& sigma = initial_group_.get<TargetInitSigma>();
  initial_ = {.t_us = unwrap_us(vertical.time_of_validity_us, now_us_),
              .latitude = latitude.latitude_deg * radians,
              .longitude = longitude.longitude_deg * radians,
              .height = latitude.height_m,
              .v_north = horizontal.velocity_north_mps,
              .v_east = horizontal.velocity_east_mps,
              .v_down = vertical.velocity_down_mps,
              .roll = attitude.roll_deg * radians,
              .pitch = attitude.pitch_deg * radians,
              .heading = attitude.heading_deg * radians,
              .position_sigma = longitude.position_sigma_m,
              .velocity_sigma = sigma.velocity_sigma_mps,
              .tilt_sigma = sigma.tilt_sigma_deg * radians,
              .heading_sigma = sigma.heading_sigma_deg * radians};
  if (adapter_ == nullptr || state_ == TargetState::fault) {
    errors_.command = true;
    return send_heartbeat();
  }
  enter(TargetState::ready);
}

template <class Message>
void Device::on_initial_air(const Frame& frame, std::uint8_t counter) {
  if (state_ == TargetState::running) {
    errors_.command = true;
    return;
  }
  const auto outcome = initial_air_group_.put(from_frame<Message>(frame), counter);
  if (outcome == InitialAirGroup::Outcome::dropped_previous) ++losses_.bad_group;
  if (outcome != InitialAirGroup::Outcome::complete) return;
  const auto& rate = initial_air_group_.get<TargetInitRate>();
  const auto& air = initial_air_group_.get<TargetInitAirVelocity>();
  initial_air_ = {
      .velocity = {air.air_velocity_x_mps, air.air_velocity_y_mps, air.air_velocity_z_mps},
      .rate = {rate.rate_x_degps * radians, rate.rate_y_degps * radians, rate.rate_z_degps * radians}};
}

void Device::apply(Health health) {
  if (health == Health::fault) enter(TargetState::fault);
}

void Device::enter(TargetState state) {
  state_ = state;
  send_heartbeat();
}

std::span<const Frame> Device::idle_heartbeat() {
  answers_.clear();
  send_heartbeat();
  return answers_.frames();
}

void Device::send_heartbeat() {
  const auto bit = [](bool set) { return static_cast<std::uint8_t>(set); };
  answers_.send(TargetHeartbeat{.state = state_,
                                .estimator = adapter_ == nullptr ? Estimator::none : adapter_->estimator(),
                                .algorithm = algorithm_,
                                .dbc_hash = dbc_hash24,
                                .version_major = version_major,
                                .version_minor = version_minor,
                                .error_dbc_mismatch = bit(errors_.dbc_mismatch),
                                .error_not_initialised = bit(errors_.not_initialised),
                                .error_input_lost = bit(errors_.input_lost),
                                .error_input_silent = bit(errors_.input_silent),
                                .error_numeric = bit(errors_.numeric),
                                .error_command = bit(errors_.command)});
}

void Device::send_counters() {
  answers_.send(TargetCounters{.frames_lost = saturated(losses_.frames_lost),
                               .bad_crc = saturated(losses_.bad_crc),
                               .bad_group = saturated(losses_.bad_group),
                               .late = saturated(losses_.late)});
}

}  // namespace canhil::target
