// What strikes between the nodes and the bus, or at the target: it changes frames on their way, and may have
// a time of its own at which it sends frames or lays hands on something.
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

/// What can be done to the target's process and to the interface; none of it is asked for where Place says
/// that it cannot be.
class RigControl {
 public:
  RigControl() = default;
  RigControl(const RigControl&) = delete;
  RigControl& operator=(const RigControl&) = delete;
  virtual ~RigControl() = default;
  virtual void pause_target() = 0;
  virtual void resume_target() = 0;
  /// Kills it, starts it again and makes it ready with the state of that time of the run.
  virtual void restart_target(std::int64_t t_us) = 0;
  /// As the interface's driver would report it.
  virtual void report_error(const Frame& error) = 0;
  /// Sets it down, and up again after that time, whatever the bench does meanwhile: it may wait for it.
  virtual void interface_down(std::int64_t for_us) = 0;
  /// Waits until it is up again.
  virtual void interface_up() = 0;
};

/// What a fault did in a run.
struct Tally {
  std::uint64_t count = 0;  ///< frames or samples that it befell, or times that it struck
  /// Frames with a value that the node did not send, right by their protection; of those, with another time.
  std::uint64_t changed = 0, changed_times = 0;
  /// Frames that came after a newer one of their message: by its time of validity a sample of one message is
  /// then late.
  std::uint64_t overtaken = 0;
};

/// A fault in a run. All that it refers to must outlive what is made of it.
struct InRun {
  const scenario::Fault& fault;
  std::uint64_t seed = 0, run_index = 0;
  std::int64_t end_us = 0;
  std::span<const MessageInfo> messages;  ///< of the bus
  const Place& place;
  RigControl* hands = nullptr;  ///< null: there is nothing to lay hands on
  Tally& tally;

  /// Random numbers of this fault; `part`: of one of its parts, each of which has its own.
  [[nodiscard]] world::Stream stream(std::string_view part = "") const;
};

class Injector {
 public:
  Injector() = default;
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;
  virtual ~Injector() = default;

  /// Changes the frames of a transmission that is due at `t_us`.
  virtual void befall(std::vector<Frame>& /*frames*/, std::int64_t /*t_us*/) {}
  /// When it does something by itself; nodes::never_us: no more.
  [[nodiscard]] virtual std::int64_t due_us() const { return nodes::never_us; }
  /// Does it, and appends the frames that are then sent.
  virtual void transmit(std::vector<Frame>& /*out*/) {}
  /// The run is over, however it ended: lets go what it holds.
  virtual void end() {}
  /// Until when the target's silence is its doing.
  [[nodiscard]] virtual std::int64_t silent_until_us() const {
    return std::numeric_limits<std::int64_t>::min();
  }
};

/// One that is on from the start of each stretch to its end.
class Switched : public Injector {
 public:
  Switched(const When& when, const InRun& run);
  [[nodiscard]] std::int64_t due_us() const final { return due_us_; }
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
  std::int64_t ended_us_ = std::numeric_limits<std::int64_t>::min();  // of the last stretch that began
};

/// One that does something every so often within its time.
class Repeated : public Injector {
 public:
  Repeated(const When& when, std::int64_t period_us, const InRun& run);
  [[nodiscard]] std::int64_t due_us() const final { return due_us_; }
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
