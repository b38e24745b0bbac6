// Models the counters of a receiver that follows the protocol. The input is the frames that the bench hands
// over to the bus: they show which frames were withheld by nodes and which were
// damaged by faults.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/loss_counts.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/frame.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {

/// For each sample group, the number of the target's estimators that use it: each estimator counts the groups
/// that it drops.
using Takers = std::map<std::string_view, std::uint64_t>;

class ReceiverModel {
 public:
  explicit ReceiverModel(const Takers& takers);

  /// The bench handed over a frame at `now_us` of its time base; `valid_us`: the time of validity of the
  /// sample group that the frame completes, if any. Returns whether the frame completes a group that an
  /// estimator must use: whole, valid, and neither early nor late.
  bool sent(const Frame& frame, std::optional<std::int64_t> valid_us, std::int64_t now_us);
  /// A Sync was handed over.
  void synchronised(bool lockstep);

  /// Limits for the counts that the target sends now. In lockstep the target has read all frames up to the
  /// last Sync; in real time its reading may lag behind by less than a period of TargetCounters.
  [[nodiscard]] checks::ExpectedCounts expected() const;
  /// The longest time [us] up to `now_us` without a group that an estimator must use, if at least four groups
  /// were due in this time. 0: no group was missing for so long.
  [[nodiscard]] std::int64_t longest_gap_us(std::int64_t now_us) const;

 private:
  // The state of one sample group, as in SampleGroup.
  struct Group {
    std::uint64_t takers = 0;
    std::int64_t each_us = 0;    // period in the DBC
    unsigned all = 0, seen = 0;  // one bit per message
    std::uint8_t counter = 0;
    bool invalid = false;  // a validity flag of the group says invalid
    std::optional<std::int64_t> valid_us{}, last_valid_us{};
    std::int64_t reached_us = 0;            // time of validity of the last complete and valid group
    std::optional<std::int64_t> used_us{};  // time at which the last group that must be used was sent
    std::int64_t longest_gap_us = 0;
  };
  struct Place {
    Group* group = nullptr;  // null: a message without a group, or a message that no estimator uses
    unsigned bit = 0;
    std::uint64_t validity_bits = 0;  // in the payload: all 1 if the sensor declares the sample valid
  };

  bool put(const Frame& frame, Place& place, std::optional<std::int64_t> valid_us, std::int64_t now_us);
  [[nodiscard]] std::int64_t faster_reached_us(const Group& group) const;

  std::map<std::string_view, Group> groups_;
  std::array<Place, messages::all_messages.size()> places_{};
  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  checks::LossCounts counts_;
  // Complete groups that an estimator may refuse, and groups that it may count as late.
  std::uint64_t refusable_ = 0, may_be_late_ = 0;
  std::deque<checks::LossCounts> at_sync_;  // the counts at the last Syncs; the newest is last
  bool lockstep_ = false;
};

}  // namespace canhil::protocol
