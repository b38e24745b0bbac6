// Sends the samples of a scenario's sensors as the messages of a mapping.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/mapping/conversation.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/nodes/kind.hpp"
#include "dbc/protection/protection.hpp"

namespace canhil::mapping {

class Player final : public nodes::Node {
 public:
  /// Returns an error if the scenario has no table for a node that the mapping plays, or if the period of a
  /// play is not a multiple of the period of its node.
  static Result<void> check(const Mapping& mapping, const scenario::Scenario& scenario);

  /// `conversation` and everything in `run` must outlive the player. The scenario must have passed check().
  Player(Conversation& conversation, const nodes::Run& run);

  [[nodiscard]] std::int64_t due_us() const override;
  void transmit(nodes::Transmission& out) override;
  /// Whether the target's answers guide the vehicle of a sensor.
  [[nodiscard]] bool listens() const override;
  bool hear(const Frame& frame, std::int64_t now_us) override;

 private:
  // A sensor whose samples are played.
  struct Played {
    std::unique_ptr<sensors::Sensor> sensor;
    const sensors::Kind* kind = nullptr;
    std::int64_t period_us = 0;
  };
  // Accumulates a quantity of a sensor between transmissions of a play.
  struct Value {
    double newest = 0, sum = 0;  // newest value; sum since the play was last sent
    double rate = 0;             // as last sent
    bool valid = true;           // whether the newest sample says so
    double over_us = 0;          // sum of the samples' intervals since the play was last sent
  };
  struct Due {
    std::size_t play = 0;
    Sent sent;
    bool lost = false;
    std::size_t next = 0;  // the frame that is put out next
  };

  // A play that a sample triggers.
  struct Triggered {
    std::size_t play = 0;
    sensors::Sample sample;
  };

  // The newest answer with a LOS rate. Its two planes may come in two messages.
  struct LosRate {
    std::int64_t cause_us = -1;
    std::optional<double> pitch{}, yaw{};
  };

  void sample(Played& played, std::vector<Triggered>& triggered);
  void take(const sensors::Kind& kind, const sensors::Sample& sample);
  void restart(const Play& play);
  void send_without_sensor(std::int64_t now_us);
  [[nodiscard]] std::int64_t next_without_sensor_us(std::size_t play) const;
  void insert(Due due);
  void add_frames(Sent& sent, const Mapped& of, std::vector<std::uint8_t> bytes);
  void add_clipped(const dbc::Message& message, const Source& source, double value);
  Sent put_together(std::size_t index, const sensors::Sample& sample, std::int64_t due_us);
  double value_of(std::size_t play, const Source& source, std::int64_t stamp_us);

  Conversation& conversation_;
  std::int64_t end_us_;  // of the run
  std::vector<Played> sensors_;
  std::vector<std::map<const sensors::Measurand*, Value>> values_;  // for each play
  std::vector<std::int64_t> samples_;  // for each play: number of samples, sent or lost
  std::deque<Due> due_;                // ascending by time
  nodes::Clipped clipped_;             // by the samples that are due
  std::map<std::string, protection::Sender> shared_;
  std::map<const dbc::Message*, protection::Sender> own_;
  Places places_;
  LosRate los_rate_;
  std::vector<double> heard_;  // signal values of one message
  std::map<const Hear*, Receiver> receivers_;
  std::map<const dbc::Message*, unsigned> sequences_;  // of fast packets
};

}  // namespace canhil::mapping
