// The requests of the bench to a target before a run, and the target's answers.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bench/drive/link.hpp"
#include "bench/nodes/node.hpp"
#include "bench/protocol/second_target.hpp"
#include "bench/protocol/sightings.hpp"
#include "dbc/wire/result.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {

/// Keeps the target's latest answers to commands.
class Mailbox final : public observe::Observer {
 public:
  void received(const Received& received) override;
  void foreign(const Received& received) override;
  [[nodiscard]] bool is(messages::Estimator estimator, messages::TargetState state) const {
    const auto& beat = beats_[static_cast<std::size_t>(estimator)];
    return beat && beat->state == state;
  }
  [[nodiscard]] bool has_stopped(messages::Estimator estimator) const {
    const auto& beat = beats_[static_cast<std::size_t>(estimator)];
    return beat && beat->state != messages::TargetState::running;
  }
  void forget_heartbeats() {
    heartbeat.reset();
    beats_ = {};
  }
  std::optional<messages::TargetHeartbeat> heartbeat;  ///< the latest one
  std::optional<messages::ParamAck> acknowledgement;   ///< received in the current step
  bool foreign_heartbeat = false;  ///< a heartbeat came in a format that this bus does not use
  bool other_bench = false;        ///< a Sync of another bench was received

 private:
  std::array<std::optional<messages::TargetHeartbeat>, 8> beats_;  // by the three-bit value of the signal
                                                                   // `estimator`
};

/// Sends requests and waits for their effects.
class Dialogue {
 public:
  /// If waiting for the target is pointless, returns the reason.
  using Gone = std::function<std::optional<std::string>()>;
  using Request = std::function<void(nodes::Transmission&)>;
  using Condition = std::function<bool(const Mailbox&)>;

  /// One step of the dialogue. `doing`: what happens to the target, for example "being reset". `awaited`: the
  /// state of the target that the bench expects, for example "idle".
  struct Step {
    std::string doing;
    std::string awaited;
    std::int64_t limit_ns = 0;
  };

  Dialogue(Link& link, nodes::Transmission& out, const Gone& gone)
      : link_(link),
        out_(out),
        gone_(gone),
        attached_(link, mailbox_),
        second_attached_(link, second_),
        sightings_attached_(link, sightings_) {}

  /// Sends `request` at once and then every `repeat_ns`, until `condition` is true. Error: one line, which
  /// says what was received instead.
  Result<void> until(const Step& step, const Request& request, const Condition& condition);

  /// Receives frames for `duration_ns`.
  void listen(std::int64_t duration_ns);

  Mailbox& mailbox() { return mailbox_; }

 private:
  [[nodiscard]] std::string complaint(const Step& step) const;
  Result<void> send(const Request& request);

  Link& link_;
  nodes::Transmission& out_;
  const Gone& gone_;
  Mailbox mailbox_;
  protocol::SecondTarget second_;
  protocol::Sightings sightings_;  // frames received in the current step
  Attached attached_, second_attached_, sightings_attached_;
};

/// The time after which an unanswered request is repeated; longer than a heartbeat period.
inline constexpr std::int64_t repeat_ns = 300'000'000;
/// The time limit for each step except the first.
inline constexpr std::int64_t answer_limit_ns = 2'000'000'000;

}  // namespace canhil::drive
