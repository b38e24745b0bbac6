// What the device asks of an estimator's adapter: sample groups in, output frames out. One adapter file an
// estimator.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dbc/wire/transmit.hpp"
#include "target/device/consistency.hpp"
#include "target/device/parameter_table.hpp"

namespace canhil::target {

/// Answers to one frame: at the most, of each estimator that an IMU drives, a navigation group and the filter
/// groups of as many fixes as may wait for the IMU. One sample may bring them all, of two estimators 134.
using Answers = Outbox<160>;

/// What was lost, by cause, since reset.
struct Losses {
  std::uint32_t frames_lost = 0;
  std::uint32_t bad_crc = 0;
  std::uint32_t bad_group = 0;
  std::uint32_t late = 0;
};

/// Why the device had to leave normal operation; mirrors the error bits of TargetHeartbeat.
struct Errors {
  bool dbc_mismatch = false;
  bool not_initialised = false;
  bool input_lost = false;
  bool input_silent = false;
  bool numeric = false;
  bool command = false;
};

/// What the group TargetInitAir knows besides, at the same time: for a body that flies in moving air. Body
/// axes.
struct InitialAir {
  std::array<double, 3> velocity{};  ///< w.r.t. the air [m/s]
  std::array<double, 3> rate{};      ///< [rad/s]
};

/// Initial navigation state as the TargetInit group carries it. SI, rad, NED.
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
  std::optional<InitialAir> air{};  ///< none: not told
};

/// What an adapter sees of the device while it works on one frame.
struct Context {
  std::int64_t now_us = 0;  ///< time base of the bench, from the last Sync
  Answers& answers;
  Losses& losses;
  Errors& errors;
  ConsistencyMonitor& consistency;  ///< to be told of every innovation; answers carry what it says
};

/// Outcome of a step that can end a run.
enum class Health : std::uint8_t { good, fault };

/// One estimator behind the bus. No method allocates, throws or blocks.
class Adapter {
 public:
  Adapter() = default;
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;
  virtual ~Adapter() = default;

  [[nodiscard]] virtual messages::Estimator estimator() const = 0;
  /// Back to the state after construction, with an algorithm; false: the estimator has no such algorithm.
  virtual bool reset(messages::Algorithm algorithm) = 0;
  /// Sets a parameter; `running` after start. Accepted values take effect at the next step.
  virtual messages::ParameterStatus set(messages::Parameter parameter, double value, bool running) = 0;
  /// Value in force; none: not a parameter of this estimator.
  [[nodiscard]] virtual std::optional<double> get(messages::Parameter parameter) const = 0;
  /// What it may be; none: not a parameter of this estimator.
  [[nodiscard]] virtual std::optional<ParameterRange> range(messages::Parameter parameter) const = 0;
  /// Starts from an initial state.
  virtual void start(const InitialState& initial) = 0;
  /// One frame of a sensor, its protection already checked; `counter` is its E2E counter.
  virtual Health receive(const Frame& frame, std::uint8_t counter, Context context) = 0;
  /// The time base moved on: notices inputs that stay away.
  virtual Health tick(Context context) = 0;
};

}  // namespace canhil::target
