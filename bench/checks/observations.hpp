// Observations of a run: the target's answers and the time stamps of all frames.
#pragma once

#include <algorithm>
#include <any>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "bench/checks/bus.hpp"
#include "bench/checks/complaints.hpp"
#include "bench/checks/exchange.hpp"
#include "bench/checks/host.hpp"
#include "bench/checks/loss_counts.hpp"
#include "bench/checks/sighting.hpp"
#include "bench/checks/target_reports.hpp"
#include "bench/checks/timing_record.hpp"
#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// Counts of the stimuli of a sample group.
struct StimulusCount {
  std::uint64_t count = 0;
  std::int64_t first_us = 0;
  std::int64_t last_us = 0;
  void add(std::int64_t valid_us) {
    first_us = count == 0 ? valid_us : std::min(first_us, valid_us);
    last_us = count == 0 ? valid_us : std::max(last_us, valid_us);
    ++count;
  }
};

/// A fault of the scenario in this run.
struct FaultRecord {
  std::string name;
  scenario::Window window;         ///< by time of transmission
  std::int64_t valid_from_us = 0;  ///< earliest time of validity of a sample that the fault may affect
  bool of_target = false;          ///< the fault acts on the target's process
  std::uint64_t count = 0;         ///< number of times that the fault took effect; 0: it did not strike
};

/// Everything that the checks judge, apart from the truth.
struct Observations {
  Observations() : Observations(messages::all_messages) {}
  /// `on_bus`: the messages of the bus.
  explicit Observations(std::span<const MessageInfo> on_bus)
      : answers(on_bus.size()), from_target(on_bus.size()), timing(on_bus) {}

  /// The answers of an estimator. The estimator's folder defines their type, `Answers`. The first call
  /// creates an empty object of this type.
  template <class Answers>
  [[nodiscard]] Answers& of() {
    std::any& own = answered[typeid(Answers)];
    if (!own.has_value()) own.emplace<Answers>();
    return *std::any_cast<Answers>(&own);
  }
  template <class Answers>
  [[nodiscard]] const Answers& of() const {
    static const Answers none{};
    const auto own = answered.find(typeid(Answers));
    return own == answered.end() ? none : *std::any_cast<Answers>(&own->second);
  }
  std::map<std::type_index, std::any> answered;  ///< answers by their type

  /// Frames of the targets that were lost, by their counters.
  [[nodiscard]] std::uint64_t lost_from_target() const {
    std::uint64_t sum = 0;
    for (const Sighting& one : from_target) sum += one.lost;
    return sum;
  }
  /// Frames of the targets with a wrong checksum, counter or size.
  [[nodiscard]] std::uint64_t spoilt_from_target() const {
    std::uint64_t sum = 0;
    for (const Sighting& one : from_target) sum += one.wrong_crc + one.wrong_counter + one.wrong_size;
    return sum;
  }

  std::map<std::string_view, StimulusCount> stimuli;  ///< by sample group; only groups that are answered
  std::vector<std::uint64_t> answers;                 ///< by index in timing.messages
  std::vector<Sighting> from_target;                  ///< by index in timing.messages
  /// The minimum interval [s] between two answers, for each answer group that keeps such an interval even if
  /// its stimuli come faster.
  std::map<std::string_view, double> own_interval_s{};
  std::int64_t first_ns = 0;   ///< stamp of the bench's first transmission
  std::int64_t last_ns = 0;    ///< stamp of the bench's last transmission
  wire::BitRates bit_rates{};  ///< bit rates of the bus; nominal 0: the rate is unknown, or the bus has none
  TimingRecord timing;         ///< empty where no times are measured
  /// The target owes each sample an answer; false: only a message every cycle, if its DBC has a cycle time.
  bool answers_each_sample = true;
  bool transmit_stamps_echoed = false;  ///< stamps of stimuli come from the echo on the bus, not the bench

  std::optional<messages::TargetCounters> counters;  ///< the last counters that the target sent
  std::string target_version{};                      ///< "0.2", from the target's first heartbeat; empty: no
                                                     ///< heartbeat came
  Complaints complaints;              ///< errors that the target reported in addition to its answers
  TargetReports reports;              ///< what the target reported about its own state
  std::vector<Exchange> exchanges{};  ///< requests of events, in the order in which they were sent
  std::vector<FaultRecord> faults{};  ///< of the scenario; one for each time that a fault was active
  std::optional<std::int64_t> longest_input_gap_us{};  ///< see protocol::ReceiverModel::longest_gap_us; none:
                                                       ///< no model observed the run
  ExpectedCounts expected_counts{};                    ///< limits for `counters`
  std::vector<wire::BitLength> length_by_second{};     ///< lengths of all frames on the bus; see
                                                       ///< observe::LoadMeter
  std::uint32_t receive_overflows = 0;                 ///< frames that the bench's own port lost
  std::uint16_t queue_max_us = 0;  ///< largest queueing time in TargetTiming; saturates at 8191
  std::uint16_t compute_max_us = 0;
  bool target_timing_seen = false;
  std::vector<std::string> clipped{};  ///< signals of the bench that could not hold a value, one line each
  BusRecord bus;
  HostRecord host;
};

}  // namespace canhil::checks
