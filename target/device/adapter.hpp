// The interface of an adapter, which connects an estimator to the bus: an adapter takes the frames of sample
// groups and returns answers. Each estimator has one adapter file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dbc/wire/transmit.hpp"
#include "target/device/consistency.hpp"
#include "target/device/parameter_table.hpp"

namespace canhil::target {

/// The answers to one received frame. There are at most 148 frames, namely if both alignment estimators run:
/// then one IMU sample triggers, for each of the two estimators, a navigation group and the filter groups of
/// all fixes that waited for this sample, and for in-flight alignment a prediction.
using Answers = Outbox<160>;

/// Numbers of lost or discarded frames and groups since reset, by reason.
struct Losses {
  std::uint32_t frames_lost = 0;
  std::uint32_t bad_crc = 0;
  std::uint32_t bad_group = 0;
  std::uint32_t late = 0;
};

/// The errors that the device reports: the error bits of TargetHeartbeat.
struct Errors {
  bool dbc_mismatch = false;
  bool not_initialised = false;
  bool input_lost = false;
  bool input_silent = false;
  bool numeric = false;
  bool command = false;
};

/// The content of the optional group TargetInitAir, for a vehicle that flies in moving air. The values are
/// valid at the time of the initial state and are in body axes.
struct InitialAir {
  std::array<double, 3> velocity{};  ///< w.r.t. the air [m/s]
  std::array<double, 3> rate{};      ///< [rad/s]
};

/// Initial navigation state from the TargetInit group. SI, rad, NED.
struct InitialState {
  std::int64_t t_us = 0;
  double latitude = 0;
  double longitude = 0;
  double height = 0;
  double v_north = 0;
  double v_east = 0;
  double v_down = 0;
  double roll = 0;
  double pitch = 0;
  double heading = 0;
  double position_sigma = 0;  ///< [m]
  double velocity_sigma = 0;  ///< [m/s]
  double tilt_sigma = 0;
  double heading_sigma = 0;
  std::optional<InitialAir> air{};  ///< none: not received
};

/// The part of the device that an adapter can use while it processes one frame.
struct Context {
  std::int64_t now_us = 0;  ///< time base of the bench, from the last Sync
  Answers& answers;
  Losses& losses;
  Errors& errors;
  ConsistencyMonitor& consistency;  ///< tests the innovations; answers contain its degraded()
};

/// The outcome of a step; `fault` ends the run of the estimator.
enum class Health : std::uint8_t { good, fault };

/// The connection of one estimator to the bus. No method allocates, throws or blocks.
class Adapter {
 public:
  Adapter() = default;
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;
  virtual ~Adapter() = default;

  [[nodiscard]] virtual messages::Estimator estimator() const = 0;
  /// Restores the state that the adapter had after construction, and selects an algorithm; false: unknown
  /// algorithm.
  virtual bool reset(messages::Algorithm algorithm) = 0;
  /// Sets a parameter; `running` is true after the start. Accepted values take effect at the next step.
  virtual messages::ParameterStatus set(messages::Parameter parameter, double value, bool running) = 0;
  /// The current value of a parameter; none: this estimator does not have the parameter.
  [[nodiscard]] virtual std::optional<double> get(messages::Parameter parameter) const = 0;
  /// The permitted values of a parameter; none: this estimator does not have the parameter.
  [[nodiscard]] virtual std::optional<ParameterRange> range(messages::Parameter parameter) const = 0;
  /// Starts from an initial state.
  virtual void start(const InitialState& initial) = 0;
  /// Processes one sensor frame. The device has checked its E2E protection; `counter` is its E2E counter.
  virtual Health receive(const Frame& frame, std::uint8_t counter, Context context) = 0;
  /// Detects missing inputs; called when the time base has advanced.
  virtual Health tick(Context context) = 0;
};

}  // namespace canhil::target
