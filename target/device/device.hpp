// The device under test: a pure function of the frames it was given. No socket, no clock, no thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dbc/wire/e2e.hpp"
#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/time_base.hpp"
#include "target/device/adapter.hpp"

namespace canhil::target {

/// hil-target without its process: commands, parameters, initial state, heartbeat, counters, and one
/// estimator at work.
class Device {
 public:
  Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() = default;

  /// Processes one frame and returns the frames that answer it, in order; valid until the next call.
  /// Frames that are not for the target are ignored. Allocates nothing.
  std::span<const Frame> receive(const Frame& frame);

  /// A heartbeat that no frame asked for: sent by the process while no bench keeps the time base.
  std::span<const Frame> idle_heartbeat();

  [[nodiscard]] messages::TargetState state() const { return state_; }
  /// True while the bench drives the time base step by step.
  [[nodiscard]] bool lockstep() const { return lockstep_; }

 private:
  void dispatch(const Frame& frame, std::uint8_t counter);
  void on_sync(const messages::Sync& sync);
  void on_command(const messages::TargetCommand& command);
  void on_parameter(const messages::ParamSet& request);
  template <class Message>
  void on_initial(const Frame& frame, std::uint8_t counter);
  void on_initial_state();
  template <class Message>
  void on_initial_air(const Frame& frame, std::uint8_t counter);
  void apply(Health health);
  void reset(messages::Estimator estimator, messages::Algorithm algorithm);
  void start();
  void enter(messages::TargetState state);
  void send_heartbeat();
  void send_counters();
  [[nodiscard]] Context context() { return {now_us_, answers_, losses_, errors_}; }

  using InitialGroup =
      SampleGroup<messages::TargetInitLatitude, messages::TargetInitLongitude, messages::TargetInitVelocityNE,
                  messages::TargetInitVelocityD, messages::TargetInitAttitude, messages::TargetInitSigma>;

  using InitialAirGroup = SampleGroup<messages::TargetInitRate, messages::TargetInitAirVelocity>;

  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  Answers answers_;
  Losses losses_;
  Errors errors_;
  InitialGroup initial_group_;
  InitialAirGroup initial_air_group_;
  InitialState initial_;
  std::optional<InitialAir> initial_air_;
  std::vector<std::unique_ptr<Adapter>> adapters_;  // all of them, made at start-up
  Adapter* adapter_ = nullptr;                      // the selected one
  messages::TargetState state_{};
  messages::Algorithm algorithm_{};
  std::int64_t now_us_ = 0;
  std::int64_t heartbeat_due_us_ = 0;
  bool lockstep_ = false;
  bool untouched_ = false;  // nothing has happened since start
};

}  // namespace canhil::target
