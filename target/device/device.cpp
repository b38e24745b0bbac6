#include "target/device/device.hpp"

#include <algorithm>
#include <numbers>

#include "dbc/version/version.hpp"
#include "dbc/wire/routes.hpp"
#include "target/device/adapters.hpp"

namespace canhil::target {
namespace {

using namespace messages;

constexpr std::int64_t heartbeat_period_us = TargetHeartbeat::info.cycle_time_us;
constexpr double radians = std::numbers::pi / 180.0;
// The device reads all messages except those that the target itself sends.
constexpr Routes routes([](const MessageInfo& info) { return info.sender != TargetHeartbeat::info.sender; });

constexpr std::uint16_t saturated(std::uint32_t count) {
  return static_cast<std::uint16_t>(std::min(count, 8191U));
}

}  // namespace

Device::Device(Rounding rounding) : answers_(rounding), adapters_(make_adapters()) {
  selected_.reserve(adapters_.size());
  selected_.emplace_back();
}

// Null: the target has no such estimator.
Adapter* Device::adapter_of(Estimator estimator) const {
  const auto found =
      std::ranges::find_if(adapters_, [&](const auto& adapter) { return adapter->estimator() == estimator; });
  return found == adapters_.end() ? nullptr : found->get();
}

std::optional<ParameterRange> Device::range(messages::Estimator estimator,
                                            messages::Parameter parameter) const {
  const Adapter* adapter = adapter_of(estimator);
  return adapter == nullptr ? std::nullopt : adapter->range(parameter);
}

std::span<const Frame> Device::receive(const Frame& frame) {
  answers_.clear();
  const std::size_t route = routes(frame);
  if (route == Routes::nowhere) return {};
  const MessageInfo& info = all_messages[route];
  if (frame.size != info.size || frame.fd != info.fd) {
    ++losses_.bad_crc;
    raise(&Errors::input_lost);
    return {};
  }
  e2e::Receiver& receiver = receivers_[route];
  switch (receiver.check(frame.payload(), info.e2e_data_id)) {
    case e2e::Check::wrong_crc:
      ++losses_.bad_crc;
      raise(&Errors::input_lost);
      return {};
    case e2e::Check::repeated:
      // Commands are processed even with a repeated counter: the first command of a new bench may have the
      // same counter value as the last command of the previous bench.
      if (frame.id != TargetCommand::info.id) {
        ++losses_.late;
        return {};
      }
      break;
    case e2e::Check::some_lost:
      losses_.frames_lost += static_cast<std::uint32_t>(receiver.lost());
      raise(&Errors::input_lost);
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
      for_running([&](Estimation& estimation, const Context& context) {
        estimation.untouched = false;
        return estimation.adapter->receive(frame, counter, context);
      });
  }
}

// An estimator that returns a fault stops; the other estimators continue.
template <class Step>
void Device::for_running(Step&& step) {
  for (Estimation& estimation : selected_) {
    if (estimation.state != TargetState::running) continue;
    const Context context{now_us_, answers_, losses_, estimation.errors, estimation.consistency};
    if (step(estimation, context) == Health::fault) enter(estimation, TargetState::fault);
  }
}

void Device::on_sync(const Sync& sync) {
  now_us_ = static_cast<std::int64_t>(sync.time_us);
  lockstep_ = sync.lockstep != 0;
  for (Estimation& estimation : selected_) estimation.untouched = false;
  for_running(
      [](Estimation& estimation, const Context& context) { return estimation.adapter->tick(context); });
  if (now_us_ >= heartbeat_due_us_) {
    heartbeat_due_us_ = (now_us_ / heartbeat_period_us + 1) * heartbeat_period_us;
    send_heartbeats();
    send_counters();
  }
  if (lockstep_) answers_.send(StepDone{.step = sync.step});
}

void Device::on_command(const TargetCommand& command) {
  if (command.dbc_hash != exchange_hash24(name_of(command.estimator))) {
    raise(&Errors::dbc_mismatch);
    return send_heartbeats();
  }
  switch (command.command) {
    case Command::reset:
      return reset(command.estimator, command.algorithm);
    case Command::add:
      return add(command.estimator, command.algorithm);
    case Command::start:
      return start();
    case Command::stop:
      return stop();
    case Command::none:
      break;
    default:  // not in the DBC
      raise(&Errors::command);
  }
  send_heartbeats();
}

void Device::reset(Estimator estimator, Algorithm algorithm) {
  receivers_ = {};
  answers_.reset_counters();
  losses_ = {};
  initial_group_.discard();
  initial_air_group_.discard();
  now_us_ = 0;
  heartbeat_due_us_ = 0;
  lockstep_ = false;
  selected_.clear();
  selected_.emplace_back();
  Estimation& first = current();
  first.algorithm = algorithm;
  first.errors.command = !select(estimator, algorithm, first);
  enter(first, TargetState::idle);
}

// Selects an additional estimator. If the same command is repeated (by a bench that missed the answer), the
// device selects the estimator again.
void Device::add(Estimator estimator, Algorithm algorithm) {
  const bool again = current().adapter != nullptr && current().adapter->estimator() == estimator;
  const bool elsewhere =
      std::any_of(selected_.begin(), std::prev(selected_.end()),
                  [&](const Estimation& other) { return other.adapter->estimator() == estimator; });
  Estimation added;
  if (running() || current().adapter == nullptr || elsewhere || !select(estimator, algorithm, added)) {
    current().errors.command = true;
    return send_heartbeats();
  }
  initial_group_.discard();
  initial_air_group_.discard();
  if (again) {
    current() = added;
  } else {
    selected_.push_back(added);
  }
  enter(current(), TargetState::idle);
}

// False: the target does not have the estimator, or the estimator does not have the algorithm.
bool Device::select(Estimator estimator, Algorithm algorithm, Estimation& estimation) {
  Adapter* adapter = adapter_of(estimator);
  if (adapter == nullptr || !adapter->reset(algorithm)) return false;
  estimation.adapter = adapter;
  estimation.algorithm = algorithm;
  return true;
}

// Starts all selected estimators together, but only if all of them are ready. Therefore the answers depend
// only on the frames of this run.
void Device::start() {
  // A bench that missed the answer repeats the command.
  const bool again = all_in(TargetState::running) && std::ranges::all_of(selected_, &Estimation::untouched);
  if (all_in(TargetState::ready) || again) {
    answers_.reset_counters();  // answers must not depend on how often a command was repeated
    for (Estimation& estimation : selected_) {
      estimation.untouched = true;
      estimation.initial.air = estimation.initial_air;
      estimation.consistency.reset();
      estimation.adapter->start(estimation.initial);
      enter(estimation, TargetState::running);
    }
    return;
  }
  for (Estimation& estimation : selected_) {
    if (estimation.state == TargetState::idle) {
      estimation.errors.not_initialised = true;
    } else {
      estimation.errors.command = estimation.errors.command || estimation.state != TargetState::ready;
    }
  }
  send_heartbeats();
}

void Device::stop() {
  for (Estimation& estimation : selected_)
    enter(estimation, estimation.state == TargetState::running ? TargetState::idle : estimation.state);
}

void Device::on_parameter(const ParamSet& request) {
  ParamAck ack{.parameter = request.parameter, .value = request.value, .status = ParameterStatus::unknown};
  if (Adapter* adapter = current().adapter; adapter != nullptr) {
    ack.status = adapter->set(request.parameter, request.value, current().state == TargetState::running);
    ack.value = static_cast<float>(adapter->get(request.parameter).value_or(request.value));
  }
  answers_.send(ack);
}

template <class Message>
void Device::on_initial(const Frame& frame, std::uint8_t counter) {
  if (current().state == TargetState::running) {
    current().errors.command = true;
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
  current().initial = {.t_us = unwrap_us(vertical.time_of_validity_us, now_us_),
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
  if (current().adapter == nullptr || current().state == TargetState::fault) {
    current().errors.command = true;
    return send_heartbeat(current());
  }
  enter(current(), TargetState::ready);
}

template <class Message>
void Device::on_initial_air(const Frame& frame, std::uint8_t counter) {
  if (current().state == TargetState::running) {
    current().errors.command = true;
    return;
  }
  const auto outcome = initial_air_group_.put(from_frame<Message>(frame), counter);
  if (outcome == InitialAirGroup::Outcome::dropped_previous) ++losses_.bad_group;
  if (outcome != InitialAirGroup::Outcome::complete) return;
  const auto& rate = initial_air_group_.get<TargetInitRate>();
  const auto& air = initial_air_group_.get<TargetInitAirVelocity>();
  current().initial_air = {
      .velocity = {air.air_velocity_x_mps, air.air_velocity_y_mps, air.air_velocity_z_mps},
      .rate = {rate.rate_x_degps * radians, rate.rate_y_degps * radians, rate.rate_z_degps * radians}};
}

void Device::enter(Estimation& estimation, TargetState state) {
  estimation.state = state;
  send_heartbeat(estimation);
}

// Errors on the bus concern all estimators.
void Device::raise(bool Errors::*error) {
  for (Estimation& estimation : selected_) estimation.errors.*error = true;
}

bool Device::all_in(TargetState state) const {
  return std::ranges::all_of(selected_, [&](const Estimation& one) { return one.state == state; });
}

bool Device::running() const {
  return std::ranges::any_of(selected_,
                             [](const Estimation& one) { return one.state == TargetState::running; });
}

std::span<const Frame> Device::idle_heartbeat() {
  answers_.clear();
  send_heartbeats();
  return answers_.frames();
}

void Device::send_heartbeats() {
  for (const Estimation& estimation : selected_) send_heartbeat(estimation);
}

void Device::send_heartbeat(const Estimation& estimation) {
  const auto bit = [](bool set) { return static_cast<std::uint8_t>(set); };
  const Errors& errors = estimation.errors;
  const Estimator estimator =
      estimation.adapter == nullptr ? Estimator::none : estimation.adapter->estimator();
  answers_.send(TargetHeartbeat{.state = estimation.state,
                                .estimator = estimator,
                                .algorithm = estimation.algorithm,
                                .dbc_hash = exchange_hash24(name_of(estimator)),
                                .version_major = version().major,
                                .version_minor = version().minor,
                                .error_dbc_mismatch = bit(errors.dbc_mismatch),
                                .error_not_initialised = bit(errors.not_initialised),
                                .error_input_lost = bit(errors.input_lost),
                                .error_input_silent = bit(errors.input_silent),
                                .error_numeric = bit(errors.numeric),
                                .error_command = bit(errors.command),
                                .degraded = bit(estimation.consistency.degraded())});
}

void Device::send_counters() {
  answers_.send(TargetCounters{.frames_lost = saturated(losses_.frames_lost),
                               .bad_crc = saturated(losses_.bad_crc),
                               .bad_group = saturated(losses_.bad_group),
                               .late = saturated(losses_.late)});
}

}  // namespace canhil::target
