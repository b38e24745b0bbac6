// Turns frames of mapped targets into observations, as protocol::Monitor does for canhil's own DBC.
#pragma once

#include <span>
#include <vector>

#include "bench/mapping/answers.hpp"
#include "bench/mapping/conversation.hpp"
#include "bench/mapping/pairing.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/observe/stopwatch.hpp"
#include "bench/observe/watcher.hpp"
#include "dbc/wire/message_places.hpp"

namespace canhil::mapping {

class Listener final : public observe::Watcher {
 public:
  /// `conversation` must outlive the listener. `virtual_time`: transmission takes no time; an answer arrives
  /// at the time at which its cause was sent.
  Listener(const Conversation& conversation, std::vector<checks::TimedWindow> windows, const WireFacts& wire,
           bool virtual_time);

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  void target_restarts() override;
  [[nodiscard]] const checks::Observations& observations() const override { return seen_; }
  checks::Observations finish() override;

 private:
  struct OwnPairing {
    Pairing pairing{};
    std::uint64_t uncertain = 0;             // answers whose cause is not certain
    std::int64_t apart_us = 0;               // shortest time between two possible causes of such an answer
    std::optional<std::int64_t> cause_us{};  // of the latest answer
    std::set<std::vector<bool>>
        pages{};  // of the multiplexed message that came for this cause: the signals in each
  };

  void hear(const Hear& hear, const Received& received);
  void settle(const Hear& hear, const Paired& paired);
  [[nodiscard]] bool is_another_page(const Hear& hear, const Paired& paired);
  void record(const Hear& hear, std::span<const std::uint8_t> bytes, std::int64_t t_us);
  OwnPairing& pairing_of(const Hear& hear);
  Pairing::Give settler(const Hear& hear);
  [[nodiscard]] std::int64_t bench_us(std::int64_t t_ns) const;
  [[nodiscard]] std::optional<Passing::Whole> closed_by(std::size_t message, const Frame& frame) const;

  const Conversation& conversation_;
  checks::Observations seen_;
  observe::Stopwatch stopwatch_;
  Places places_;
  Passing passing_;
  std::vector<double> values_;        // signal values of one message
  std::vector<Receiver> receivers_;   // for each hear
  std::vector<OwnPairing> pairings_;  // for each hear
  bool virtual_time_ = false, sent_any_ = false;
  std::int64_t due_us_ = 0, due_ns_ = 0;  // deadline of the last play: by time base, by clock of stamps
};

}  // namespace canhil::mapping
