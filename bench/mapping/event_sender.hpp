// Sends the events of a scenario: waits for their moments, talks by the transport protocols of their
// channels, and waits for their answers. Events of one channel are sent one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "bench/mapping/dialogue.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/nodes/node.hpp"
#include "bench/world/truth_values.hpp"
#include "dbc/transport/iso_tp.hpp"

namespace canhil::mapping {

/// The counters of the messages that events send, by channel. They continue from phase to phase.
using Counters = std::map<std::size_t, protection::Sender>;

class EventSender final : public nodes::Node {
 public:
  /// Sends the events of one phase. All arguments must outlive the sender.
  EventSender(const Mapping& mapping, const std::vector<scenario::Event>& events, scenario::Phase phase,
              Dialogue& dialogue, Counters& counters, const world::Truths& truths, std::int64_t end_us);

  [[nodiscard]] std::int64_t due_us() const override;
  void transmit(nodes::Transmission& out) override;
  [[nodiscard]] bool listens() const override { return !waiting_.empty() || !talks_.empty(); }
  bool hear(const Frame& frame, std::int64_t now_us) override;
  [[nodiscard]] bool awaits() const override;
  void give_up(std::int64_t now_us) override;

 private:
  // An event that is still to be sent.
  struct Waiting {
    std::size_t event = 0;
    std::int64_t due_us = nodes::never_us;
    std::int64_t left = 1;  // how often
    bool looks = false;     // `due_us`: when its condition is looked at again
  };
  // A request on its way.
  struct Talk {
    std::size_t event = 0;
    std::optional<transport::IsoTpSender> sender{};
    std::int64_t due_us = 0;  // of the next frame, or the end of the bench's patience
  };
  struct Ready {
    std::int64_t due_us = 0;
    Frame frame;
  };

  [[nodiscard]] const EventChannel& channel_of(std::size_t event) const;
  void look(Waiting& waiting, std::int64_t now_us);
  void begin(Waiting& waiting, std::int64_t now_us, nodes::Transmission& out);
  bool advance(Talk& talk, std::int64_t now_us, nodes::Transmission& out);
  void end(std::size_t channel, std::int64_t now_us, bool has_answer);
  void see_flags(const Frame& frame, std::int64_t now_us);

  const Mapping& mapping_;
  const std::vector<scenario::Event>& events_;
  world::Truths truths_;
  std::int64_t end_us_;
  Dialogue& dialogue_;
  Counters& counters_;
  Places places_;
  std::vector<Waiting> waiting_;
  std::map<std::size_t, Talk> talks_;          // by channel
  std::deque<Ready> ready_;                    // flow control
  std::map<std::size_t, Receiver> receivers_;  // by index of Mapping::hears
};

}  // namespace canhil::mapping
