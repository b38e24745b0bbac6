// Follows the requests of events and their answers on the bus, in a run or in its log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "bench/checks/exchange.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/observe/observer.hpp"
#include "bench/scenario/events.hpp"
#include "dbc/transport/iso_tp.hpp"

namespace canhil::mapping {

class Dialogue final : public observe::Observer {
 public:
  /// `mapping` and `events` must outlive the dialogue.
  Dialogue(const Mapping& mapping, const std::vector<scenario::Event>& events);

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  /// Says which event sends the next request on its channel. In a log, nobody says it: there, requests belong
  /// to the events with these bytes in the order of the scenario.
  void expect(std::size_t event);
  /// Whether the last request on a channel waits for an answer.
  [[nodiscard]] bool is_open(std::size_t channel) const { return lines_[channel].open.has_value(); }
  /// Waits no longer.
  void give_up(std::size_t channel) { lines_[channel].open.reset(); }
  /// The flow control that the target needs now; none: it needs none. Each is returned once.
  std::optional<transport::Bytes> flow_control(std::size_t channel);
  /// All exchanges so far, in the order of their requests.
  [[nodiscard]] const std::vector<checks::Exchange>& exchanges() const { return exchanges_; }

 private:
  // What is on the bus for one channel.
  struct Line {
    explicit Line(const EventChannel& channel) : requests(channel.settings), answers(channel.settings) {}
    transport::IsoTpReceiver requests, answers;
    std::optional<std::size_t> event{};  // that sends the next request
    std::optional<std::size_t> open{};   // index of the exchange that waits for an answer
    std::optional<transport::Bytes> flow_control{};
    std::optional<Frame> last{};  // of the newest request
  };
  void asked(std::size_t channel, const Frame& frame, transport::Bytes request, std::int64_t t_ns);
  void answered(std::size_t channel, transport::Bytes answer, std::int64_t t_ns);
  [[nodiscard]] std::optional<std::size_t> by_order(std::size_t channel, const transport::Bytes& request);

  const Mapping& mapping_;
  const std::vector<scenario::Event>& events_;
  std::vector<Line> lines_;  // for each channel
  std::vector<checks::Exchange> exchanges_;
  std::map<std::size_t, std::int64_t> seen_;  // how often an event was seen
};

/// Whether a frame has the id of a message.
bool is_of(const Frame& frame, const Mapped& message);

}  // namespace canhil::mapping
