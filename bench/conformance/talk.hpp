// A dialogue with a target, command by command. The target is the only other node on the bus.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/drive/buses.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/drive/target_process.hpp"
#include "bench/processes/child_process.hpp"
#include "bench/protocol/decode_from_target.hpp"
#include "bench/protocol/heartbeat_errors.hpp"

namespace canhil::conformance {

class Talk {
 public:
  /// Starts the target and waits for its first heartbeat. `scenario` defines the estimator and the inputs of
  /// the target, and must outlive the Talk, as `stop`, which ends all waiting. `target` is the command that
  /// starts the target. Returns an error if the target does not start or sends no heartbeat, or if the
  /// scenario cannot be flown.
  static Result<std::unique_ptr<Talk>> open(const scenario::Scenario& scenario, const std::string& target,
                                            const std::atomic<bool>& stop);

  /// Makes the command `what`, with the scenario's estimator and algorithm.
  [[nodiscard]] messages::TargetCommand command(messages::Command what) const;

  template <class Message>
  void send(const Message& message) {
    listener_.frames.clear();
    out_.clear();
    out_.send(message);
    send();
  }
  /// Sends a command whose counter equals the counter of the previous command.
  template <class Message>
  void repeat(const Message& message) {
    listener_.frames.clear();
    const Frame frame = to_frame(message, last_counter_);
    static_cast<void>(link_.send(frame, patience_ns));
  }
  /// Sends those frames of the scenario's initial state for which `sent` returns true.
  void send_state(const std::function<bool(const Frame&)>& sent = [](const Frame&) { return true; });
  /// Sends parameter frames with a wrong CRC.
  void send_damaged(int frames);
  /// In all frames that are sent later, adds `shift_us` to the time (time base or time of validity).
  void shift_time(std::int64_t shift_us) { shift_us_ = shift_us; }
  /// Sends the time base before a flight. The target needs the time base to extend a 32-bit time of validity:
  /// it takes the full time that is nearest to the time base.
  void send_time();

  /// Waits for a message that arrives after the last transmission and satisfies `condition`. Returns nullopt
  /// if no such message arrives within `answer_ns`.
  template <class Message, class Condition>
  std::optional<Message> hear(Condition condition) {
    const std::int64_t deadline_ns = link_.now_ns() + answer_ns;
    for (;;) {
      static_cast<void>(link_.drain());
      for (; !listener_.frames.empty(); listener_.frames.pop_front()) {
        const auto message = protocol::decode_from_target<Message>(listener_.frames.front());
        if (message && condition(*message)) return message;
      }
      if (over(deadline_ns)) return std::nullopt;
    }
  }
  bool waits_for(messages::TargetState state);
  /// Why the dialogue with the target is pointless: its process ended; empty: it runs.
  [[nodiscard]] std::string gone();
  /// Ends the target's process. Returns what is wrong with its end; empty: nothing.
  [[nodiscard]] std::string end();
  /// Listens for `duration_ns`. Returns the received messages of type Message, each with its time stamp.
  template <class Message>
  std::vector<std::pair<std::int64_t, Message>> hear_all(std::int64_t duration_ns) {
    listener_.frames.clear();
    const std::int64_t deadline_ns = link_.now_ns() + duration_ns;
    while (!over(deadline_ns)) static_cast<void>(link_.drain());
    static_cast<void>(link_.drain());
    std::vector<std::pair<std::int64_t, Message>> all;
    for (const Received& received : listener_.frames) {
      if (const auto message = protocol::decode_from_target<Message>(received))
        all.emplace_back(received.t_ns, *message);
    }
    return all;
  }
  /// Sets a parameter. Returns the target's acknowledgement; nullopt: none arrived.
  std::optional<messages::ParamAck> set(messages::Parameter parameter, double value);

  // reset(), make_ready() and start() return a description of the violation; an empty string: none.
  std::string reset();
  std::string make_ready();  ///< sends a reset, then the initial state
  std::string start();

  /// A function that appends to `instead` the frames that are sent in place of `frame`: none, `frame` itself,
  /// another frame, or several frames.
  using Tamper = std::function<void(const Frame& frame, std::vector<Frame>& instead)>;

  /// Continues the flight for `duration_us`, in lockstep. Returns the number of the target's frames that are
  /// answers. The flight ends early if the target does not complete a step with StepDone.
  int fly(std::int64_t duration_us, const Tamper& tamper = {});
  /// Data of the last flight. flown(): the frames of the bench's nodes, before Tamper replaced any of them.
  /// heard(): the target's frames up to the last StepDone; later frames are omitted, because fly() does not
  /// wait for them. closed(): whether the target completed each step.
  [[nodiscard]] const std::vector<Frame>& flown() const { return flown_; }
  [[nodiscard]] std::vector<Frame> heard() const;
  [[nodiscard]] bool closed() const { return closed_; }
  /// The answers of the last flight.
  [[nodiscard]] std::vector<Frame> answers() const;
  /// first_received() and last_received(): the first and the last message of type Message that arrived during
  /// the last flight.
  template <class Message>
  std::optional<Message> first_received() const {
    for (const Received& received : listener_.frames) {
      if (const auto message = protocol::decode_from_target<Message>(received)) return message;
    }
    return std::nullopt;
  }
  template <class Message>
  std::optional<Message> last_received() const {
    std::optional<Message> last;
    for (const Received& received : listener_.frames) {
      if (const auto message = protocol::decode_from_target<Message>(received)) last = message;
    }
    return last;
  }
  template <class Message>
  std::optional<Message> hear_in_flight(std::int64_t duration_us) {
    fly(duration_us);
    return last_received<Message>();
  }

  Talk(const scenario::Scenario& scenario, world::FlightRecord truth, drive::Flight flight,
       drive::OpenBuses buses, processes::ChildProcess target, const std::atomic<bool>& stop);

 private:
  static constexpr std::int64_t answer_ns = 2'000'000'000, step_ns = 3'000'000'000,
                                patience_ns = 5'000'000'000;

  struct NodeListener final : observe::Observer {
    void received(const Received& received) override {
      if (!received.own) frames.push_back(received);
    }
    std::deque<Received> frames;
  };

  void send();
  void send(Frame frame);
  // Waits for a frame, but not for long. Returns whether the deadline has passed, or the dialogue is stopped.
  bool over(std::int64_t deadline_ns);
  void begin_flight();
  bool closes(std::uint16_t step);

  const scenario::Scenario& scenario_;
  world::FlightRecord truth_;
  drive::Flight flight_;
  std::shared_ptr<std::vector<std::string>> notes_;
  std::unique_ptr<Port> port_;
  drive::Link link_;
  processes::ChildProcess target_;
  const std::atomic<bool>& stop_;
  nodes::Transmission out_;
  NodeListener listener_;
  drive::Attached attached_;
  std::unique_ptr<drive::Schedule> schedule_;
  std::int64_t flown_us_ = 0, shift_us_ = 0;
  std::vector<Frame> flown_;
  bool closed_ = true;
  std::uint8_t last_counter_ = 0;
};

}  // namespace canhil::conformance
