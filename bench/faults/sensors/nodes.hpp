// Faults of a node as a whole: the measured values are correct, but the transmission times, the counters or
// the reported times are wrong.
#pragma once

#include "bench/faults/read.hpp"
#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// Shared by all kinds of node faults.
struct OfNode {
  static constexpr Stage stage = Stage::node;
  const scenario::NodeTable* table = nullptr;
  When when{};
  [[nodiscard]] std::string subject() const { return table == nullptr ? "" : std::string(table->key); }
  [[nodiscard]] bool acts_on(const scenario::NodeTable& sensor) const { return &sensor == table; }
};

/// The node sends nothing, and its counters do not advance.
struct Silent : OfNode {
  static constexpr std::string_view kind = "silent";
  static constexpr std::string_view meaning =
      "The node sends nothing; afterwards its counters continue where they stopped. The increments of the "
      "silent time are lost.";
  static Silent read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The node is silent for a time; then its counters restart at 0. The measurements of the silent time are
/// lost.
struct NodeRestart : OfNode {
  static constexpr std::string_view kind = "restart";
  static constexpr std::string_view meaning =
      "The node is silent for `silent_s`; then its counters begin at 0.";
  static NodeRestart read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The node's samples are sent late, but with the correct time of validity.
struct Late : OfNode {
  static constexpr std::string_view kind = "late";
  static constexpr std::string_view meaning = "The sample is sent later. Its time of validity stays correct.";
  static constexpr Stage stage = Stage::sensor;
  std::int64_t by_us = 0;
  static Late read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The node sends less often. Each transmission contains the newest sample of the node, with the sum of the
/// increments since the previous transmission.
struct Slow : OfNode {
  static constexpr std::string_view kind = "slow";
  static constexpr std::string_view meaning =
      "The node sends samples with a longer period. Each time, the node sends the newest sample; its "
      "increments include those of the samples that were not sent.";
  double longer = 0;  ///< additional period as a fraction of the correct period
  static Slow read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The times that the node reports have an offset.
struct ClockStep : OfNode {
  static constexpr std::string_view kind = "clock_step";
  static constexpr std::string_view meaning =
      "All times of validity that the node sends are wrong by `by_ms`.";
  std::int64_t by_us = 0;
  static ClockStep read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The clock of the node runs too fast or too slow. This also affects the intervals that the node reports.
struct ClockDrift : OfNode {
  static constexpr std::string_view kind = "clock_drift";
  static constexpr std::string_view meaning =
      "The clock of the node runs at a wrong rate. If the clock is too fast, the node's times of validity "
      "get more and more ahead of the true times, and the time intervals in its samples are too long. If the "
      "clock is too slow, the opposite is true.";
  double rate = 0;
  static ClockDrift read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

}  // namespace canhil::faults
