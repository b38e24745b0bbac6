// Faults between nodes and bus, or of the target. An injector changes frames on their way to the bus. It may
// also act at times of its own: it then sends frames or uses RigControl.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bench/faults/place.hpp"
#include "bench/faults/when.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/world/stream.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::faults {

/// Actions on the process of the target and on the CAN interface. Faults do not call an action in runs for
/// which Place excludes it.
class RigControl {
 public:
  RigControl() = default;
  RigControl(const RigControl&) = delete;
  RigControl& operator=(const RigControl&) = delete;
  virtual ~RigControl() = default;
  virtual void pause_target() = 0;
  virtual void resume_target() = 0;
  /// Kills the target, starts it again, and configures it with the initial state for `t_us`, a time of the
  /// run.
  virtual void restart_target(std::int64_t t_us) = 0;
  /// Reports an error frame, as the driver of the interface would report it.
  virtual void report_error(const Frame& error) = 0;
  /// Sets the interface down and, after `for_us`, up again, even while the bench waits for the interface.
  virtual void interface_down(std::int64_t for_us) = 0;
  /// Waits until the interface is up again.
  virtual void interface_up() = 0;
};

/// The effect of a fault in a run.
struct Tally {
  std::uint64_t count = 0;  ///< number of affected frames or samples, or of activations
  /// `changed`: number of frames with a changed value but a valid counter and CRC. `changed_times`: number of
  /// those frames in which a time was changed.
  std::uint64_t changed = 0, changed_times = 0;
  /// Number of frames that were sent after a newer frame of the same message. If a sample has a single
  /// message, the target recognises by the time of validity that the sample is late.
  std::uint64_t overtaken = 0;
};

/// A fault in a run. Everything to which this object refers must outlive the injectors that are made from it.
struct InRun {
  const scenario::Fault& fault;
  std::uint64_t seed = 0, run_index = 0;
  std::int64_t end_us = 0;
  std::span<const MessageInfo> messages;  ///< all messages of the bus
  const Place& place;
  RigControl* hands = nullptr;  ///< null: not available
  Tally& tally;
  const Trigger* trigger = nullptr;  ///< of a fault that begins in the run; null: of another

  /// The active time of the fault in this run.
  [[nodiscard]] When in(const When& when) const {
    When own = when;
    own.trigger = trigger;
    return own;
  }
  /// Random numbers of this fault; each `part` of a fault has its own stream.
  [[nodiscard]] world::Stream stream(std::string_view part = "") const;
};

class Injector {
 public:
  Injector() = default;
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;
  virtual ~Injector() = default;

  /// Changes the frames of a transmission that is due at `t_us`.
  virtual void apply(std::vector<Frame>& /*frames*/, std::int64_t /*t_us*/) {}
  /// The time at which the injector next acts on its own, in transmit(); nodes::never_us if it does not.
  [[nodiscard]] virtual std::int64_t due_us() const { return nodes::never_us; }
  /// Acts on its own at due_us(), and appends the frames that are to be sent.
  virtual void transmit(std::vector<Frame>& /*out*/) {}
  /// Called at the end of the run, however the run ends: releases the frames or resources that the fault
  /// holds.
  virtual void end() {}
  /// The end of the time during which this fault explains why the target is silent.
  [[nodiscard]] virtual std::int64_t silent_until_us() const {
    return std::numeric_limits<std::int64_t>::min();
  }
};

/// A fault that is switched on at the start and off at the end of each stretch. A stretch is an uninterrupted
/// part of the active time of the fault.
class Switched : public Injector {
 public:
  Switched(const When& when, const InRun& run);
  [[nodiscard]] std::int64_t due_us() const final;
  void transmit(std::vector<Frame>& out) final;
  void end() final {
    if (on_) off();
    on_ = false;
  }
  [[nodiscard]] std::int64_t silent_until_us() const override {
    return silences() ? ended_us_ : Injector::silent_until_us();
  }

 protected:
  virtual void on(std::int64_t for_us) = 0;
  virtual void off() = 0;
  [[nodiscard]] virtual bool silences() const { return false; }
  RigControl* const rig_;

 private:
  When when_;
  Tally& tally_;
  bool on_ = false;
  std::int64_t due_us_;
  std::int64_t begun_us_ = -1;  // when a fault that begins in the run began
  std::int64_t ended_us_ = std::numeric_limits<std::int64_t>::min();  // end of the latest stretch
};

/// A fault that acts periodically while it is active.
class Repeated : public Injector {
 public:
  Repeated(const When& when, std::int64_t period_us, const InRun& run);
  [[nodiscard]] std::int64_t due_us() const final;
  void transmit(std::vector<Frame>& out) final;

 protected:
  virtual void strike(std::vector<Frame>& out) = 0;

 private:
  void move_into_time();
  When when_;
  std::int64_t period_us_, due_us_;
  Tally& tally_;
};

}  // namespace canhil::faults
