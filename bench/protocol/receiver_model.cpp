#include "bench/protocol/receiver_model.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <type_traits>

#include "dbc/wire/bits.hpp"
#include "dbc/wire/routes.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;

constexpr Routes bench_messages([](const MessageInfo& info) { return !is_targets(info); });

// An estimator may drop a group that arrives more than this time before or after the group's time of
// validity.
constexpr std::int64_t promised_us = 200'000;
constexpr std::size_t syncs_of_a_period =
    static_cast<std::size_t>(TargetHeartbeat::info.cycle_time_us / Sync::info.cycle_time_us);

template <class Message>
std::uint64_t validity_bits_of() {
  std::uint64_t bits = 0;
  const Message any{};
  Message::visit(any, [&](const SignalInfo& signal, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Validity>)
      bits |= std::uint64_t{1} << wire::bit_position(signal.start_bit, 0, signal.big_endian);
  });
  return bits;
}

std::uint64_t bits_of(const Frame& frame) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) bits |= std::uint64_t{frame.data[i]} << (8 * i);
  return bits;
}

}  // namespace

ReceiverModel::ReceiverModel(const Takers& takers) {
  for (std::size_t i = 0; i < all_messages.size(); ++i) {
    const auto taken = takers.find(all_messages[i].sample_group);
    if (taken == takers.end()) continue;
    Group& group = groups_[taken->first];
    group.takers = taken->second;
    group.each_us = all_messages[i].cycle_time_us;
    places_[i] = {.group = &group, .bit = group.all + 1};
    group.all = 2 * group.all + 1;
  }
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    ((places_[message_index<Messages>()].validity_bits = validity_bits_of<Messages>()), ...);
  }(std::type_identity<AllMessages>{});
}

// A damaged frame, or one of the wrong size, does not advance the receiver's counter: the frame counts as
// damaged and, when the next frame arrives, also as lost.
bool ReceiverModel::sent(const Frame& frame, std::optional<std::int64_t> valid_us, std::int64_t now_us) {
  const std::size_t index = bench_messages(frame);
  if (index == Routes::nowhere) return false;
  const MessageInfo& info = all_messages[index];
  if (frame.size != info.size || frame.fd != info.fd) {
    ++counts_.bad_crc;
    return false;
  }
  switch (receivers_[index].check(frame.payload(), info.e2e_data_id)) {
    case e2e::Check::wrong_crc:
      ++counts_.bad_crc;
      return false;
    case e2e::Check::repeated:
      ++counts_.late;
      return false;
    case e2e::Check::some_lost:
      counts_.frames_lost += static_cast<std::uint64_t>(receivers_[index].lost());
      break;
    case e2e::Check::ok:
      break;
  }
  return places_[index].group != nullptr && put(frame, places_[index], valid_us, now_us);
}

bool ReceiverModel::put(const Frame& frame, Place& place, std::optional<std::int64_t> valid_us,
                        std::int64_t now_us) {
  Group& group = *place.group;
  const std::uint8_t counter = e2e::counter(frame.payload());
  if (group.seen != 0 && counter != group.counter) {
    counts_.bad_group += group.takers;
    group.seen = 0;
  }
  if (group.seen == 0) group.invalid = false;
  group.counter = counter;
  group.seen |= place.bit;
  group.invalid = group.invalid || (bits_of(frame) & place.validity_bits) != place.validity_bits;
  if (valid_us) group.valid_us = valid_us;
  if (group.seen != group.all) return false;
  group.seen = 0;
  bool early = false, late = false;
  if (group.valid_us) {
    early = *group.valid_us > std::min(now_us, faster_reached_us(group)) + promised_us;
    late = *group.valid_us < now_us - promised_us || *group.valid_us <= group.last_valid_us;
    group.last_valid_us = group.valid_us;
    if (!group.invalid) group.reached_us = *group.valid_us;
  }
  if (early || group.invalid) refusable_ += group.takers;
  if (late) may_be_late_ += group.takers;
  if (early || late || group.invalid) return false;
  group.longest_gap_us = std::max(group.longest_gap_us, now_us - group.used_us.value_or(0));
  group.used_us = now_us;
  return true;
}

std::int64_t ReceiverModel::longest_gap_us(std::int64_t now_us) const {
  std::int64_t longest_us = 0;
  for (const auto& [name, group] : groups_) {
    if (!group.used_us) continue;  // a group that no node of this run sends
    const std::int64_t gap_us = std::max(group.longest_gap_us, now_us - *group.used_us);
    if (gap_us >= 4 * group.each_us) longest_us = std::max(longest_us, gap_us);
  }
  return longest_us;
}

// The time of validity that all groups with shorter periods have reached. The time of an estimator follows
// its fastest samples. While the fastest samples are missing, the estimator holds back samples of slower
// groups if they are valid later.
std::int64_t ReceiverModel::faster_reached_us(const Group& group) const {
  std::int64_t least_us = std::numeric_limits<std::int64_t>::max();
  for (const auto& [name, other] : groups_) {
    if (other.each_us < group.each_us) least_us = std::min(least_us, other.reached_us);
  }
  return least_us;
}

void ReceiverModel::synchronised(bool lockstep) {
  lockstep_ = lockstep;
  at_sync_.push_back(counts_);
  if (at_sync_.size() > syncs_of_a_period) at_sync_.pop_front();
}

checks::ExpectedCounts ReceiverModel::expected() const {
  checks::ExpectedCounts expected{.least = {}, .most = counts_};
  if (!at_sync_.empty()) expected.least = lockstep_ ? at_sync_.back() : at_sync_.front();
  expected.most.bad_group += refusable_;
  expected.most.late += may_be_late_;
  return expected;
}

}  // namespace canhil::protocol
