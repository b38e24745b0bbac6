// The device under test: a pure function of its input frames. No socket, no clock, no thread.
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

/// The part of hil-target without the process around it. Handles commands, parameters and the initial state,
/// sends heartbeats and counters, and runs the estimators. Several estimators can run at once on the same
/// sensor frames, independently of each other.
class Device {
 public:
  /// `rounding` applies to the answers. Use Rounding::none only if the bench is in the same process.
  explicit Device(Rounding rounding = Rounding::as_on_the_bus);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() = default;

  /// Processes one frame and returns the answering frames in order. They stay valid until the next call.
  /// Frames that are not for the target are ignored. Allocates nothing.
  std::span<const Frame> receive(const Frame& frame);

  /// Returns a heartbeat for each selected estimator, without an input frame. The process sends these
  /// heartbeats while no bench sends Sync or commands.
  std::span<const Frame> idle_heartbeat();

  /// The permitted values of a parameter; none: there is no such estimator or parameter.
  [[nodiscard]] std::optional<ParameterRange> range(messages::Estimator estimator,
                                                    messages::Parameter parameter) const;

  /// True while any estimator runs.
  [[nodiscard]] bool running() const;
  /// True while the bench drives the time base step by step.
  [[nodiscard]] bool lockstep() const { return lockstep_; }

 private:
  /// A selected estimator.
  struct Estimation {
    Adapter* adapter = nullptr;  // null: none is selected, or the target does not have the selected one
    messages::Algorithm algorithm{};
    messages::TargetState state{};
    Errors errors{};
    ConsistencyMonitor consistency{};
    InitialState initial{};
    std::optional<InitialAir> initial_air{};
    bool untouched = false;  // no input since start
  };

  void dispatch(const Frame& frame, std::uint8_t counter);
  void on_sync(const messages::Sync& sync);
  void on_command(const messages::TargetCommand& command);
  void on_parameter(const messages::ParamSet& request);
  template <class Message>
  void on_initial(const Frame& frame, std::uint8_t counter);
  void on_initial_state();
  template <class Message>
  void on_initial_air(const Frame& frame, std::uint8_t counter);
  template <class Step>
  void for_running(Step&& step);
  void reset(messages::Estimator estimator, messages::Algorithm algorithm);
  void add(messages::Estimator estimator, messages::Algorithm algorithm);
  [[nodiscard]] Adapter* adapter_of(messages::Estimator estimator) const;
  bool select(messages::Estimator estimator, messages::Algorithm algorithm, Estimation& estimation);
  void start();
  void stop();
  void enter(Estimation& estimation, messages::TargetState state);
  void raise(bool Errors::*error);
  void send_heartbeat(const Estimation& estimation);
  void send_heartbeats();
  void send_counters();
  [[nodiscard]] bool all_in(messages::TargetState state) const;
  /// The estimator that was selected last. Parameters and initial state apply to this estimator.
  [[nodiscard]] Estimation& current() { return selected_.back(); }

  using InitialGroup =
      SampleGroup<messages::TargetInitLatitude, messages::TargetInitLongitude, messages::TargetInitVelocityNE,
                  messages::TargetInitVelocityD, messages::TargetInitAttitude, messages::TargetInitSigma>;

  using InitialAirGroup = SampleGroup<messages::TargetInitRate, messages::TargetInitAirVelocity>;

  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  Answers answers_;
  Losses losses_;
  InitialGroup initial_group_;
  InitialAirGroup initial_air_group_;
  std::vector<std::unique_ptr<Adapter>> adapters_;  // of all estimators, created at start-up
  std::vector<Estimation> selected_;                // never empty; has capacity for all estimators
  std::int64_t now_us_ = 0;
  std::int64_t heartbeat_due_us_ = 0;
  bool lockstep_ = false;
};

}  // namespace canhil::target
