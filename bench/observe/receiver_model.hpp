// What a receiver that keeps the contract counts of the frames that the bench hands over: what nodes withheld
// and faults damaged shows in the frames themselves, whoever did it.
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

namespace canhil::observe {

/// How many estimators of the target take each sample group: each counts the groups that it drops.
using Takers = std::map<std::string_view, std::uint64_t>;

class ReceiverModel {
 public:
  explicit ReceiverModel(const Takers& takers);

  /// The bench handed over a frame at `now_us` of its time base; `valid_us`: the time of validity of the
  /// sample group that it closes, if it closes one.
  void sent(const Frame& frame, std::optional<std::int64_t> valid_us, std::int64_t now_us);
  /// A Sync was handed over.
  void synchronised(bool lockstep);

  /// The limits of counts that the target sends now. In lockstep it has read all up to the last Sync; in real
  /// time it may be late, by less than a period of TargetCounters.
  [[nodiscard]] checks::ExpectedCounts expected() const;

 private:
  // Of the messages of one sample group, as SampleGroup keeps them.
  struct Group {
    std::uint64_t takers = 0;
    std::int64_t each_us = 0;    // by the contract
    unsigned all = 0, seen = 0;  // a bit a message
    std::uint8_t counter = 0;
    bool invalid = false;  // a flag in it says so
    std::optional<std::int64_t> valid_us{}, last_valid_us{};
    std::int64_t reached_us = 0;  // validity of the last whole one without such a flag
  };
  struct Place {
    Group* group = nullptr;  // null: a message that stands alone, or that no estimator takes
    unsigned bit = 0;
    std::uint64_t validity_bits = 0;  // of the payload: all 1 where the sensor vouches for the sample
  };

  void put(const Frame& frame, Place& place, std::optional<std::int64_t> valid_us, std::int64_t now_us);
  [[nodiscard]] std::int64_t faster_reached_us(const Group& group) const;

  std::map<std::string_view, Group> groups_;
  std::array<Place, messages::all_messages.size()> places_{};
  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  checks::LossCounts counts_;
  // Whole groups that an estimator may refuse, and such as it may count as late.
  std::uint64_t refusable_ = 0, may_be_late_ = 0;
  std::deque<checks::LossCounts> at_sync_;  // the last ones, the newest last
  bool lockstep_ = false;
};

}  // namespace canhil::observe
