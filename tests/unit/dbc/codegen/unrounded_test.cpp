// Unrounded frames: the packed bytes stay the same, and the unrounded signals travel beside them.
#include "dbc/wire/unrounded.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <random>

#include "dbc/codegen/definitions.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/message.hpp"
#include "dbc/wire/transmit.hpp"
#include "messages/canhil.hpp"

namespace canhil::dbc {
namespace {

/// Calls test<Message>() for every message of canhil.dbc.
template <std::size_t i = 0, class Test>
void for_every_message(const Test& test) {
  if constexpr (i < std::tuple_size_v<messages::AllMessages>) {
    test.template operator()<std::tuple_element_t<i, messages::AllMessages>>();
    for_every_message<i + 1>(test);
  }
}

template <class Message>
std::vector<std::uint64_t> bits_of_doubles(const Message& message) {
  std::vector<std::uint64_t> bits;
  Message::visit(message, [&](const SignalInfo&, auto member) {
    if constexpr (std::is_same_v<decltype(member), double>)
      bits.push_back(std::bit_cast<std::uint64_t>(member));
  });
  return bits;
}

Message message_of(const std::string& text) {
  const auto database = parse(text, "x.dbc");
  EXPECT_TRUE(database) << database.error().message;
  return database->messages.front();
}

TEST(Unrounded, EveryDoubleOfTheContractTravelsBitForBit) {
  std::mt19937_64 random(1);
  int doubles = 0;
  for_every_message([&]<class Message>() {
    for (int i = 0; i < 200; ++i) {
      Message message;
      Message::visit(message, [&]<class Member>(const SignalInfo& info, Member& member) {
        if constexpr (std::is_same_v<Member, double>) {
          member = std::uniform_real_distribution<double>(info.minimum, info.maximum)(random);
          ++doubles;
        }
      });
      const auto received = from_frame<Message>(to_frame(message, 3, Rounding::none));
      EXPECT_EQ(bits_of_doubles(received), bits_of_doubles(message)) << Message::info.name;
    }
  });
  EXPECT_GT(doubles, 200 * 40);
}

TEST(Unrounded, EveryScaledSignalOfTheContractIsCarried) {
  for_every_message([]<class Message>() {
    std::size_t doubles = 0;
    const Message message;
    Message::visit(message, [&](const SignalInfo&, auto member) {
      doubles += std::is_same_v<decltype(member), double>;
    });
    EXPECT_EQ(Message::scaled().size(), doubles) << Message::info.name;
    EXPECT_TRUE(Message::info.can_travel_unrounded) << Message::info.name;
    EXPECT_LE(Message::size + 8 * doubles, Frame::max_size) << Message::info.name;
  });
}

// The packed bytes are the same as on the bus, so protection, groups, lengths and loads are the same too.
TEST(Unrounded, ThePackedBytesAreThoseOfTheBus) {
  std::mt19937_64 random(2);
  for_every_message([&]<class Message>() {
    std::array<std::uint8_t, Message::size> bytes{};
    std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random()); });
    const Message message = Message::unpack(bytes);
    const Frame rounded = to_frame(message, 3), unrounded = to_frame(message, 3, Rounding::none);
    EXPECT_TRUE(std::ranges::equal(rounded.payload(), unrounded.payload())) << Message::info.name;
    EXPECT_FALSE(rounded.unrounded);
    EXPECT_TRUE(unrounded.unrounded);
    EXPECT_FALSE(rounded == unrounded) << "what an observer compares distinguishes the two";
  });
}

TEST(Unrounded, IntegersTravelAsOnTheBus) {
  messages::AlignUpdate message{.cause_time_us = 123'456'789, .cause_counter = 9, .nis = 1.23456789};
  const auto received = from_frame<messages::AlignUpdate>(to_frame(message, 0, Rounding::none));
  EXPECT_EQ(received, message);
}

TEST(Unrounded, SaturatesAsTheContractDoes) {
  messages::AlignVelocityNE message{.velocity_north_mps = 1e9, .velocity_east_mps = -1e9};
  message = from_frame<messages::AlignVelocityNE>(to_frame(message, 0, Rounding::none));
  EXPECT_EQ(message.velocity_north_mps, 1677);
  EXPECT_EQ(message.velocity_east_mps, -1677);
  message.velocity_north_mps = std::nan("");
  EXPECT_EQ(from_frame<messages::AlignVelocityNE>(to_frame(message, 0, Rounding::none)).velocity_north_mps,
            -1677);
}

TEST(Unrounded, AnOutboxSendsAllItsMessagesSo) {
  Outbox<1> exact(Rounding::none), rounded;
  exact.send(messages::AlignVelocityNE{.velocity_north_mps = 1.23456789});
  rounded.send(messages::AlignVelocityNE{.velocity_north_mps = 1.23456789});
  const auto north = [](const auto& out) {
    return from_frame<messages::AlignVelocityNE>(out.frames().front()).velocity_north_mps;
  };
  EXPECT_EQ(north(exact), 1.23456789);
  EXPECT_NE(north(rounded), 1.23456789);
}

TEST(Unrounded, AMultiplexorStaysAndAnOffsetAloneIsScaling) {
  const std::string text =
      "BS_:\nBU_: A\nBO_ 1 M: 8 A\n SG_ m M : 0|4@1+ (2,1) [0|0] \"\" A\n"
      " SG_ b : 8|16@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_TRUE(can_travel_unrounded(message_of(text)));
  EXPECT_THAT(definitions_text(message_of(text)), testing::HasSubstr("ScaledMember, 0>"));
  const Message offset = message_of(text + " SG_ a : 24|16@1+ (1,-40) [0|0] \"\" A\n");
  EXPECT_THAT(definitions_text(offset), testing::HasSubstr("offsetof(M, a)"));
  const Message multiplexed = message_of(text + " SG_ a m0 : 24|16@1+ (1,-40) [0|0] \"\" A\n");
  EXPECT_FALSE(can_travel_unrounded(multiplexed)) << "only the packed bytes say whether it is there";
}

TEST(Unrounded, AMessageWhoseDoublesDoNotFitCannotTravelSo) {
  std::string text = "BS_:\nBU_: A\nBO_ 1 M: 8 A\n";
  for (int i = 0; i < 7; ++i) text += fmt::format(" SG_ s{} : {}|7@1- (0.1,0) [0|0] \"\" A\n", i, 7 * i);
  EXPECT_TRUE(can_travel_unrounded(message_of(text))) << "8 bytes and seven doubles are 64";
  text += " SG_ s7 : 56|1@1+ (0.5,0) [0|0] \"\" A\n";
  EXPECT_FALSE(can_travel_unrounded(message_of(text)));
}

}  // namespace
}  // namespace canhil::dbc
