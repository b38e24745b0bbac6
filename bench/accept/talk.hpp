// A target of its own, on a bus of its own, to which commands are told one by one.
#pragma once

#include <fmt/format.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/drive/buses.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/drive/target_process.hpp"
#include "bench/observe/heard.hpp"
#include "bench/observe/heartbeat_errors.hpp"

namespace canhil::accept {

class Talk {
 public:
  /// Starts the target and waits for its first heartbeat. `scenario`: whose estimator it is to be, and what
  /// it then hears; must outlive the talk. Error: it does not start, or the scenario cannot be flown.
  static Result<std::unique_ptr<Talk>> open(const scenario::Scenario& scenario, const std::string& target);

  /// For the scenario's estimator and algorithm.
  [[nodiscard]] messages::TargetCommand command(messages::Command what) const;

  template <class Message>
  void tell(const Message& message) {
    ear_.frames.clear();
    out_.clear();
    out_.send(message);
    send();
  }
  /// A message with the counter of the last one of its kind.
  template <class Message>
  void repeat(const Message& message) {
    ear_.frames.clear();
    const Frame frame = to_frame(message, last_counter_);
    static_cast<void>(link_.send(frame, patience_ns));
  }
  /// The scenario's initial state.
  void tell_state();
  /// Frames of the time base with a wrong CRC.
  void tell_damaged(int frames);

  /// Waits for a message after what was told last that a condition holds of; none: it did not come.
  template <class Message, class Condition>
  std::optional<Message> hear(Condition condition) {
    const std::int64_t deadline_ns = link_.now_ns() + answer_ns;
    for (;;) {
      static_cast<void>(link_.drain());
      for (; !ear_.frames.empty(); ear_.frames.pop_front()) {
        const auto message = observe::heard<Message>(ear_.frames.front());
        if (message && condition(*message)) return message;
      }
      if (link_.now_ns() >= deadline_ns) return std::nullopt;
      link_.wait_until(deadline_ns);
    }
  }
  bool waits_for(messages::TargetState state);
  /// Sets a parameter, and gives its acknowledgement.
  std::optional<messages::ParamAck> set(const std::string& parameter, double value);

  // Each says what was wrong; empty: nothing.
  std::string reset();
  std::string make_ready();  ///< a reset, then the initial state
  std::string start();

  /// Flies on for so long, in lockstep; how many answers to samples came.
  int fly(std::int64_t duration_us);
  /// The answers of the last flight on.
  [[nodiscard]] std::vector<Frame> answers() const;
  /// The last one that came while it flew on.
  template <class Message>
  std::optional<Message> hear_in_flight(std::int64_t duration_us) {
    fly(duration_us);
    std::optional<Message> last;
    for (const Received& received : ear_.frames) {
      if (const auto message = observe::heard<Message>(received)) last = message;
    }
    return last;
  }

  Talk(const scenario::Scenario& scenario, world::FlightRecord truth, drive::Flight flight,
       drive::OpenBuses buses, drive::TargetProcess target);

 private:
  static constexpr std::int64_t answer_ns = 2'000'000'000, step_ns = 5'000'000'000,
                                patience_ns = 5'000'000'000;

  struct Ear final : observe::Observer {
    void received(const Received& received) override {
      if (!received.own) frames.push_back(received);
    }
    std::deque<Received> frames;
  };

  void send();
  void begin_flight();

  const scenario::Scenario& scenario_;
  world::FlightRecord truth_;
  drive::Flight flight_;
  std::shared_ptr<std::vector<std::string>> notes_;
  std::unique_ptr<Port> port_;
  drive::Link link_;
  drive::TargetProcess target_;
  nodes::Transmission out_;
  Ear ear_;
  drive::Attached attached_;
  std::unique_ptr<drive::Schedule> schedule_;
  std::int64_t flown_us_ = 0;
  std::uint8_t last_counter_ = 0;
};

}  // namespace canhil::accept
