// Counters, covered bytes, sender and receiver.
#include "dbc/protection/protection.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <set>

namespace canhil::protection {
namespace {

using Bytes = std::vector<std::uint8_t>;

Settings counted(std::uint64_t modulo, std::vector<std::uint64_t> skipped = {}, unsigned length = 8) {
  Settings settings;
  settings.counter =
      Counter{.place = {0, length, false}, .modulo = modulo, .skipped = std::move(skipped), .shared_as = {}};
  return settings;
}

Protection made(Settings settings, unsigned size = 8) {
  return Protection::make(std::move(settings), {.id = 0x123, .size = size}).value();
}

std::vector<std::uint64_t> first_counters(const Protection& protection, int frames) {
  std::vector<std::uint64_t> counters;
  Sender sender;
  for (int i = 0; i < frames; ++i) {
    Bytes data(protection.subject().size);
    sender.protect(protection, data);
    counters.push_back(protection.counter(data));
  }
  return counters;
}

TEST(Counters, StartOverAtTheirModulo) {
  EXPECT_EQ(first_counters(made(counted(3)), 5), (std::vector<std::uint64_t>{0, 1, 2, 0, 1}));
  EXPECT_EQ(first_counters(made(counted(0, {}, 2)), 5), (std::vector<std::uint64_t>{0, 1, 2, 3, 0}));
}

TEST(Counters, LeaveOutSkippedValues) {
  EXPECT_EQ(first_counters(made(counted(6, {5, 0, 2})), 5), (std::vector<std::uint64_t>{1, 3, 4, 1, 3}));
}

TEST(Counters, SharedBySeveralMessagesGoUpWithEach) {
  Settings other = counted(4);
  other.counter->place = {8, 4, false};
  const Protection a = made(counted(4));
  const Protection b = made(other);
  ASSERT_TRUE(a.counts_like(b));
  EXPECT_FALSE(a.counts_like(made(counted(5))));
  EXPECT_FALSE(a.counts_like(made(counted(4, {3}))));
  Sender sender;
  Receiver receiver;
  for (std::uint64_t i = 0; i < 9; ++i) {
    const Protection& protection = i % 3 == 0 ? b : a;
    Bytes data(8);
    sender.protect(protection, data);
    EXPECT_EQ(protection.counter(data), i % 4);
    EXPECT_EQ(receiver.check(protection, data), Check::ok);
  }
}

// Compares with an explicit list of the permitted counters, in ascending order.
RC_GTEST_PROP(Counters, GapsAreCountedAtModuloAndSkips, ()) {
  const auto modulo = *rc::gen::inRange<std::uint64_t>(2, 257);
  auto skipped = *rc::gen::container<std::set<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, modulo));
  while (skipped.size() + 2 > modulo) skipped.erase(skipped.begin());
  std::vector<std::uint64_t> values;
  for (std::uint64_t value = 0; value < modulo; ++value)
    if (!skipped.contains(value)) values.push_back(value);

  const Protection protection = made(counted(modulo, {skipped.begin(), skipped.end()}));
  RC_ASSERT(protection.period() == values.size());
  RC_ASSERT(protection.first() == values.front());
  std::size_t index = *rc::gen::inRange<std::size_t>(0, values.size());
  Receiver receiver;
  Bytes data(8);
  protection.protect(data, values[index]);
  RC_ASSERT(receiver.check(protection, data) == Check::ok);
  for (const std::size_t steps :
       *rc::gen::container<std::vector<std::size_t>>(20, rc::gen::inRange<std::size_t>(0, values.size()))) {
    index = (index + steps) % values.size();
    protection.protect(data, values[index]);
    const Check check = receiver.check(protection, data);
    RC_ASSERT(check == (steps == 0 ? Check::repeated : steps == 1 ? Check::ok : Check::some_lost));
    RC_ASSERT(receiver.lost() == (steps == 0 ? 0 : steps - 1));
  }
  for (std::uint64_t value = 0; value < 256; ++value) {
    protection.protect(data, value);
    const bool allowed = std::ranges::find(values, value) != values.end();
    RC_ASSERT(protection.allowed(value) == allowed);
    RC_ASSERT((Receiver().check(protection, data) == Check::counter_not_allowed) == !allowed);
  }
}

TEST(Receivers, TakeNoCounterOverFromABadMessage) {
  Settings settings = counted(15, {}, 4);
  settings.checksum = Checksum{};
  settings.checksum->place = {56, 8, false};
  settings.checksum->rule = published_crc("CRC-8/SAE-J1850").value();
  const Protection protection = made(settings);
  const auto frame = [&](std::uint64_t counter) {
    Bytes data(8);
    protection.protect(data, counter);
    return data;
  };
  Receiver receiver;
  EXPECT_EQ(receiver.check(protection, frame(4)), Check::ok);
  Bytes damaged = frame(5);
  damaged[3] ^= 0x10;
  EXPECT_EQ(receiver.check(protection, damaged), Check::wrong_checksum);
  EXPECT_EQ(receiver.check(protection, frame(15)), Check::counter_not_allowed);
  EXPECT_EQ(receiver.check(protection, frame(7)), Check::some_lost);
  EXPECT_EQ(receiver.lost(), 2U);
  EXPECT_EQ(receiver.check(protection, frame(7)), Check::repeated);
  EXPECT_EQ(receiver.lost(), 0U);
  Bytes longer = frame(8);
  longer.push_back(0);
  EXPECT_EQ(receiver.check(protection, longer), Check::wrong_checksum);
  EXPECT_EQ(receiver.check(protection, Bytes(7)), Check::wrong_checksum);
  EXPECT_EQ(receiver.check(protection, {}), Check::wrong_checksum);
  receiver.reset();
  EXPECT_EQ(receiver.check(protection, frame(7)), Check::ok);
}

TEST(Receivers, OfAMessageWithoutACounterSayOkEachTime) {
  Settings settings;
  settings.checksum = Checksum{};
  settings.checksum->place = {0, 8, false};
  settings.checksum->rule = Sum{};
  const Protection protection = made(settings);
  Bytes data{0, 1, 2, 3, 4, 5, 6, 7};
  Sender sender;
  Receiver receiver;
  for (int i = 0; i < 3; ++i) {
    sender.protect(protection, data);
    EXPECT_EQ(receiver.check(protection, data), Check::ok);
  }
  EXPECT_EQ(data[0], 28);
}

TEST(Receivers, FindAWrongConstant) {
  Settings settings = counted(16, {}, 4);
  settings.constants = {{{4, 4, false}, 0xA}};
  const Protection protection = made(settings);
  Bytes data(8);
  protection.protect(data, 3);
  EXPECT_EQ(data[0], 0xA3);
  EXPECT_EQ(Receiver().check(protection, data), Check::ok);
  data[0] = 0xB3;
  EXPECT_EQ(Receiver().check(protection, data), Check::wrong_checksum);
}

// Any settings give either an error of one line or a protection. Messages with this protection pass its
// check, and the other bits of the message stay unchanged.
Place any_place() {
  return {.start_bit = *rc::gen::weightedOneOf<unsigned>(
              {{3, rc::gen::map(rc::gen::inRange(0U, 8U), [](unsigned byte) { return 8 * byte + 3; })},
               {1, rc::gen::inRange(0U, 80U)}}),
          .length = *rc::gen::weightedElement<unsigned>({{6, 4}, {6, 8}, {2, 16}, {1, 0}, {1, 13}, {1, 33}}),
          .big_endian = *rc::gen::arbitrary<bool>()};
}

std::vector<AddedByte> any_added() {
  std::vector<AddedByte> all(*rc::gen::weightedElement<std::size_t>({{9, 1}, {6, 0}, {3, 3}, {1, 17}}));
  for (AddedByte& byte : all) {
    byte.source = static_cast<Source>(*rc::gen::inRange(0, 6));
    byte.index = *rc::gen::weightedElement<unsigned>({{9, 1}, {9, 3}, {1, 4}});
    byte.value = *rc::gen::arbitrary<std::uint8_t>();
  }
  return all;
}

Settings any_settings() {
  Settings settings;
  settings.data_id = *rc::gen::arbitrary<std::uint32_t>();
  if (*rc::gen::inRange(0, 4) != 0) {
    settings.counter =
        Counter{any_place(),
                *rc::gen::weightedElement<std::uint64_t>({{6, 0}, {6, 15}, {1, 1}, {1, 40}}),
                *rc::gen::container<std::vector<std::uint64_t>>(*rc::gen::inRange<std::size_t>(0, 3),
                                                                rc::gen::inRange<std::uint64_t>(0, 20)),
                {}};
    if (*rc::gen::arbitrary<bool>() && settings.counter->place.length < 16)
      settings.data_id_list.resize(modulo(*settings.counter));
  }
  if (*rc::gen::inRange(0, 4) != 0) {
    Checksum checksum;
    checksum.place = any_place();
    if (*rc::gen::arbitrary<bool>()) {
      Crc crc{.width = checksum.place.length, .polynomial = 0x3, .start = 0x5};
      checksum.rule = crc;
    } else {
      checksum.rule = Sum{.addition = static_cast<Addition>(*rc::gen::inRange(0, 4)),
                          .start = *rc::gen::inRange<std::uint64_t>(0, 20),
                          .negated = *rc::gen::arbitrary<bool>(),
                          .final_xor = *rc::gen::inRange<std::uint64_t>(0, 20)};
    }
    checksum.bytes = *rc::gen::container<std::vector<unsigned>>(*rc::gen::inRange<std::size_t>(0, 3),
                                                                rc::gen::inRange(0U, 10U));
    checksum.own_bytes_as_zero = *rc::gen::arbitrary<bool>();
    checksum.before = any_added();
    checksum.after = any_added();
    settings.checksum = checksum;
  }
  if (*rc::gen::arbitrary<bool>())
    settings.constants.push_back(Constant{any_place(), *rc::gen::inRange<std::uint64_t>(0, 20)});
  return settings;
}

void are_refused_in_one_line_or_protect() {
  const Settings settings = any_settings();
  const auto size =
      *rc::gen::weightedOneOf<unsigned>({{3, rc::gen::inRange(8U, 65U)}, {1, rc::gen::inRange(0U, 66U)}});
  const Result<Protection> protection = Protection::make(settings, {.id = 0x18FF1234, .size = size});
  if (!protection) {
    RC_ASSERT(protection.error().message.find(", expected ") != std::string::npos);
    RC_ASSERT(protection.error().message.find('\n') == std::string::npos);
    return;
  }
  const Bytes before = *rc::gen::container<Bytes>(size, rc::gen::arbitrary<std::uint8_t>());
  Bytes data = before;
  Sender sender;
  Receiver receiver;
  for (int i = 0; i < 5; ++i) {
    sender.protect(*protection, data);
    RC_ASSERT(receiver.check(*protection, data) == Check::ok);
  }
  auto own = std::array<std::uint8_t, Frame::max_size>{};
  const auto add = [&](const Place& place) {
    for (unsigned i = 0; i < size; ++i) own[i] |= bits_of(place)[i];
  };
  if (settings.counter) add(settings.counter->place);
  if (settings.checksum) add(settings.checksum->place);
  for (const Constant& constant : settings.constants) add(constant.place);
  for (unsigned i = 0; i < size; ++i) RC_ASSERT(((before[i] ^ data[i]) & ~own[i]) == 0);
}

RC_GTEST_PROP(AnySettings, AreRefusedInOneLineOrProtect, ()) {
  for (int i = 0; i < 30; ++i) are_refused_in_one_line_or_protect();
}

}  // namespace
}  // namespace canhil::protection
