// The twin of the contract that rounds nothing.
#include "dbc/codegen/exact.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <random>

#include "dbc/codegen/generate.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "test_messages/exact.hpp"

namespace canhil::dbc {
namespace {

namespace twin = test_messages::exact;

/// Calls test<Message, its twin>(), for every message.
template <std::size_t i = 0, class Test>
void for_every_pair(const Test& test) {
  if constexpr (i < std::tuple_size_v<messages::AllMessages>) {
    test.template
    operator()<std::tuple_element_t<i, messages::AllMessages>, std::tuple_element_t<i, twin::AllMessages>>();
    for_every_pair<i + 1>(test);
  }
}

template <class Message>
bool has_doubles() {
  bool found = false;
  const Message message;
  Message::visit(message, [&](const SignalInfo&, auto member) {
    found = found || std::is_same_v<decltype(member), double>;
  });
  return found;
}

Result<Database> twin_of(std::string_view text) {
  const auto database = parse(text, "x.dbc");
  return database ? exact(*database, "x.dbc") : database;
}

TEST(Exact, EveryDoubleOfTheContractTravelsBitForBit) {
  std::mt19937_64 random(1);
  int doubles = 0;
  for_every_pair([&]<class, class Twin>() {
    for (int i = 0; i < 200; ++i) {
      Twin message;
      Twin::visit(message, [&]<class Member>(const SignalInfo& info, Member& member) {
        if constexpr (std::is_same_v<Member, double>) {
          member = std::uniform_real_distribution<double>(info.minimum, info.maximum)(random);
          ++doubles;
        }
      });
      std::vector<std::uint64_t> sent;
      const auto bits = [](std::vector<std::uint64_t>& to) {
        return [&to](const SignalInfo&, auto member) {
          if constexpr (std::is_same_v<decltype(member), double>)
            to.push_back(std::bit_cast<std::uint64_t>(member));
        };
      };
      Twin::visit(message, bits(sent));
      const auto received_message = from_frame<Twin>(to_frame(message, 3));
      std::vector<std::uint64_t> received;
      Twin::visit(received_message, bits(received));
      EXPECT_EQ(received, sent) << Twin::info.name;
    }
  });
  EXPECT_GT(doubles, 200 * 40);
}

TEST(Exact, KeepsNamesIdsGroupsRangesAndTypes) {
  for_every_pair([]<class Message, class Twin>() {
    const MessageInfo& a = Message::info;
    const MessageInfo& b = Twin::info;
    EXPECT_EQ(std::tuple(a.name, a.id, a.cycle_time_us, a.e2e_data_id, a.sender, a.sample_group),
              std::tuple(b.name, b.id, b.cycle_time_us, b.e2e_data_id, b.sender, b.sample_group));
    EXPECT_TRUE(std::ranges::equal(a.answers, b.answers)) << a.name;
    ASSERT_EQ(a.signals.size(), b.signals.size());
    for (std::size_t i = 0; i < a.signals.size(); ++i) {
      EXPECT_EQ(a.signals[i].name, b.signals[i].name);
      EXPECT_EQ(a.signals[i].minimum, b.signals[i].minimum);
      EXPECT_EQ(a.signals[i].maximum, b.signals[i].maximum);
      EXPECT_EQ(wire::lsb(b.signals[i]) == 0, b.signals[i].is_float);
      if (!b.signals[i].is_float) {
        EXPECT_EQ(a.signals[i].length, b.signals[i].length);
      }
    }
    const Message message;
    const Twin other;
    std::vector<std::size_t> sizes_a, sizes_b;
    Message::visit(message, [&](const SignalInfo&, auto m) { sizes_a.push_back(sizeof m); });
    Twin::visit(other, [&](const SignalInfo&, auto m) { sizes_b.push_back(sizeof m); });
    EXPECT_EQ(sizes_a, sizes_b);
  });
}

TEST(Exact, FramesAreFdWhereSomethingWasScaledAndUnchangedElsewhere) {
  for_every_pair([]<class Message, class Twin>() {
    EXPECT_EQ(Twin::info.fd, has_doubles<Message>()) << Message::info.name;
    if (has_doubles<Message>()) return;
    EXPECT_TRUE(std::ranges::equal(to_frame(Message{}, 3).payload(), to_frame(Twin{}, 3).payload()));
  });
  EXPECT_FALSE(twin::TargetHeartbeat::info.fd) << "twins must be able to read each other's hash";
  EXPECT_FALSE(twin::TargetCommand::info.fd) << "twins must be able to read each other's hash";
}

TEST(Exact, HashDiffersAsExchangedToo) {
  EXPECT_NE(messages::dbc_hash, twin::dbc_hash);
  EXPECT_NE(messages::dbc_hash24, twin::dbc_hash24);
}

TEST(Exact, SaturatesAsTheContractDoes) {
  twin::AlignVelocityNE message{.velocity_north_mps = 1e9, .velocity_east_mps = -1e9};
  message = from_frame<twin::AlignVelocityNE>(to_frame(message, 0));
  EXPECT_EQ(message.velocity_north_mps, 1677);
  EXPECT_EQ(message.velocity_east_mps, -1677);
}

TEST(Exact, LaysOutInOrderFloatsFromWholeBytesOn) {
  const auto database = twin_of(
      "BS_:\nBU_: A\nBO_ 1 M: 8 A\n SG_ flag : 0|3@1+ (1,0) [0|0] \"\" A\n"
      " SG_ a : 3|16@1- (0.1,0) [0|0] \"\" A\n SG_ b : 39|16@0- (0.5,2) [0|0] \"\" A\n"
      " SG_ n : 55|12@0+ (1,0) [0|0] \"\" A\n SG_ f : 56|4@1+ (1,0) [0|0] \"\" A\n");
  ASSERT_TRUE(database) << database.error().message;
  const Message& message = database->messages.front();
  std::vector<std::pair<unsigned, unsigned>> places;
  for (const Signal& signal : message.signals) places.emplace_back(signal.start_bit, signal.length);
  EXPECT_THAT(places, testing::ElementsAre(std::pair(0, 3), std::pair(8, 64), std::pair(72, 64),
                                           std::pair(136, 12), std::pair(148, 4)));
  EXPECT_EQ(message.size, 20U);
  EXPECT_TRUE(message.fd);
}

TEST(Exact, AMultiplexorStaysAndAnOffsetAloneIsScaling) {
  const auto database = twin_of(
      "BS_:\nBU_: A\nBO_ 1 M: 8 A\n SG_ m M : 0|4@1+ (2,1) [0|0] \"\" A\n"
      " SG_ a m0 : 8|16@1+ (1,-40) [0|0] \"\" A\n SG_ b m1 : 8|16@1+ (1,0) [0|0] \"\" A\n");
  ASSERT_TRUE(database) << database.error().message;
  const auto& signals = database->messages.front().signals;
  EXPECT_FALSE(signals[0].is_float());
  EXPECT_TRUE(signals[1].is_float());
  EXPECT_FALSE(signals[2].is_float());
}

TEST(Exact, AMessageThatDoesNotFitIsRefused) {
  std::string text = "BS_:\nBU_: A\nBO_ 1 M: 8 A\n";
  for (int i = 0; i < 8; ++i) text += fmt::format(" SG_ s{} : {}|7@1- (0.1,0) [0|0] \"\" A\n", i, 7 * i);
  EXPECT_TRUE(twin_of(text)) << "eight floats are 64 bytes";
  text += " SG_ s8 : 56|1@1+ (1,0) [0|0] \"\" A\n";
  const auto refused = twin_of(text);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().message,
      "x.dbc:3:5: message M takes 65 bytes with its scaled signals as 64-bit floats, expected at most 64");
}

TEST(Exact, EveryHeaderOfATwinIsSound) {
  for (const char* name : {"motorola", "multiplexed", "floats", "vector_style"}) {
    const auto database = read_file(fmt::format("{}/dbc/{}.dbc", TEST_DATA_DIR, name));
    ASSERT_TRUE(database) << database.error().message;
    const auto converted = exact(*database, name);
    ASSERT_TRUE(converted) << converted.error().message;
    const auto header = generate_header(*converted, "twin", name);
    EXPECT_TRUE(header) << header.error().message;
  }
}

}  // namespace
}  // namespace canhil::dbc
