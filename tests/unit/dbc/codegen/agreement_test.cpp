// The generated codec and the run-time codec agree bit for bit, on random frames and on random values.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"
#include "messages/canhil.hpp"
#include "test_messages/fd.hpp"
#include "test_messages/floats.hpp"
#include "test_messages/motorola.hpp"
#include "test_messages/multiplexed.hpp"
#include "test_messages/vector_style.hpp"

namespace canhil::dbc {
namespace {

template <class Types, std::uint64_t header_hash>
struct Generated {
  using Messages = Types;
  static constexpr std::uint64_t hash = header_hash;
};

struct Canhil : Generated<messages::AllMessages, messages::dbc_hash> {
  static constexpr const char* file = SOURCE_DIR "/dbc/canhil.dbc";
};
struct Motorola : Generated<test_messages::motorola::AllMessages, test_messages::motorola::dbc_hash> {
  static constexpr const char* file = TEST_DATA_DIR "/dbc/motorola.dbc";
};
struct Floats : Generated<test_messages::floats::AllMessages, test_messages::floats::dbc_hash> {
  static constexpr const char* file = TEST_DATA_DIR "/dbc/floats.dbc";
};
struct Multiplexed
    : Generated<test_messages::multiplexed::AllMessages, test_messages::multiplexed::dbc_hash> {
  static constexpr const char* file = TEST_DATA_DIR "/dbc/multiplexed.dbc";
};
struct Fd : Generated<test_messages::fd::AllMessages, test_messages::fd::dbc_hash> {
  static constexpr const char* file = TEST_DATA_DIR "/dbc/fd.dbc";
};
struct VectorStyle
    : Generated<test_messages::vector_style::AllMessages, test_messages::vector_style::dbc_hash> {
  static constexpr const char* file = TEST_DATA_DIR "/dbc/vector_style.dbc";
};

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

template <class Member>
double to_double(Member member) {
  return static_cast<double>(member);
}

double random_value(std::mt19937_64& random, const SignalInfo& info) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double low = info.minimum == info.maximum ? -1e10 : info.minimum;
  const double high = info.minimum == info.maximum ? 1e10 : info.maximum;
  std::uniform_real_distribution<double> inside(low, high);
  switch (random() % 10) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return random() % 2 == 0 ? infinity : -infinity;
    case 2:
      return random() % 2 == 0 ? low : high;
    case 3:
      return random() % 2 == 0 ? 2 * high + 1 : 2 * low - 1;
    case 4:
      return std::bit_cast<double>(random());
    case 5:
      // Close to a rounding tie.
      return info.offset + (std::floor(inside(random) / info.scale) + 0.5) * info.scale;
    default:
      return inside(random);
  }
}

template <class Member>
Member random_member(std::mt19937_64& random, const SignalInfo& info) {
  if constexpr (std::is_floating_point_v<Member>) {
    return static_cast<Member>(random_value(random, info));
  } else {
    return static_cast<Member>(random());
  }
}

// The visitors are named types, so the code of a visitor is compiled once per type of member. With lambdas,
// each message would have a separate type of visitor.
struct Collect {
  std::vector<NamedValue>& values;
  template <class Member>
  [[gnu::noinline]] void operator()(const SignalInfo& info, const Member& member) const {
    values.push_back({info.name, to_double(member)});
  }
};

/// Limits integers to values that doubles represent exactly, because the run-time codec uses doubles.
struct MakeExactAsDouble {
  template <class Member>
  void operator()(const SignalInfo& /*info*/, Member& member) const {
    if constexpr (std::is_integral_v<Member> && sizeof(Member) == 8) {
      member = static_cast<Member>(member & ~static_cast<Member>(0x7FF));
    }
  }
};

struct Randomise {
  std::mt19937_64& random;
  template <class Member>
  [[gnu::noinline]] void operator()(const SignalInfo& info, Member& member) const {
    member = random_member<Member>(random, info);
  }
};

using Bytes = std::span<const std::uint8_t>;

struct Packed {
  std::vector<std::uint8_t> bytes;
  std::vector<NamedValue> values;
};

/// The codec of a generated message type, with the type erased.
struct Codec {
  const MessageInfo& info;
  std::size_t size;
  std::vector<NamedValue> (*unpacked)(Bytes bytes);
  Packed (*repacked)(Bytes bytes);
  Packed (*packed_random)(std::mt19937_64& random);
};

template <class Message>
struct Erased {
  static std::vector<NamedValue> values(const Message& message) {
    std::vector<NamedValue> out;
    Message::visit(message, Collect{out});
    return out;
  }
  static Message unpack(Bytes bytes) { return Message::unpack(bytes.first<Message::size>()); }
  static std::vector<NamedValue> unpacked(Bytes bytes) { return values(unpack(bytes)); }
  static Packed packed(Message& message) {
    Message::visit(message, MakeExactAsDouble{});
    std::array<std::uint8_t, Message::size> bytes{};
    bytes.fill(0xA5);
    message.pack(bytes);
    return {{bytes.begin(), bytes.end()}, values(message)};
  }
  static Packed repacked(Bytes bytes) {
    Message message = unpack(bytes);
    return packed(message);
  }
  static Packed packed_random(std::mt19937_64& random) {
    Message message;
    Message::visit(message, Randomise{random});
    return packed(message);
  }
  static constexpr Codec codec{Message::info, Message::size, &unpacked, &repacked, &packed_random};
};

void expect_same_pack(const dbc::Message& definition, const Packed& packed) {
  const auto encoded = encode(definition, packed.values);
  ASSERT_TRUE(encoded);
  EXPECT_TRUE(std::ranges::equal(packed.bytes, *encoded)) << definition.name;
}

void expect_same_unpack(const dbc::Message& definition, const MessagePlan& plan, Bytes bytes,
                        const std::vector<NamedValue>& values) {
  std::vector<double> planned(plan.signals());
  ASSERT_TRUE(plan.decode(bytes, planned));
  for (const auto& [name, value] : values) {
    const Signal* signal = find_signal(definition, name);
    ASSERT_NE(signal, nullptr);
    const auto number = static_cast<std::size_t>(signal - definition.signals.data());
    const double expected = plan.is_present(number, bytes) ? planned[number] : 0.0;
    EXPECT_EQ(bits_of(value), bits_of(expected)) << definition.name << "." << name;
  }
}

void expect_agreement(const Database& database, const Codec& codec) {
  const dbc::Message* definition = find_message(database, codec.info.id, codec.info.extended);
  ASSERT_NE(definition, nullptr);
  EXPECT_EQ(definition->name, codec.info.name);
  const MessagePlan plan(*definition);
  std::mt19937_64 random(codec.info.id);
  for (int i = 0; i < 2000 && !testing::Test::HasFailure(); ++i) {
    std::vector<std::uint8_t> bytes(codec.size);
    std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random()); });
    expect_same_unpack(*definition, plan, bytes, codec.unpacked(bytes));
    expect_same_pack(*definition, codec.repacked(bytes));
    expect_same_pack(*definition, codec.packed_random(random));
  }
}

template <class... Messages>
void expect_agreement_of_all(const Database& database, const std::tuple<Messages...>* /*types*/) {
  EXPECT_EQ(database.messages.size(), sizeof...(Messages));
  (expect_agreement(database, Erased<Messages>::codec), ...);
}

template <class Case>
class CodecAgreement : public testing::Test {};
using Cases = testing::Types<Canhil, Motorola, Floats, Multiplexed, Fd, VectorStyle>;
TYPED_TEST_SUITE(CodecAgreement, Cases);

TYPED_TEST(CodecAgreement, GeneratedAndRunTimeGiveTheSameBits) {
  const auto database = read_file(TypeParam::file);
  ASSERT_TRUE(database) << database.error().message;
  expect_agreement_of_all(*database, static_cast<const typename TypeParam::Messages*>(nullptr));
}

TYPED_TEST(CodecAgreement, HeaderCarriesTheHashOfTheText) {
  const auto database = read_file(TypeParam::file);
  ASSERT_TRUE(database) << database.error().message;
  EXPECT_EQ(database->hash, TypeParam::hash);
}

}  // namespace
}  // namespace canhil::dbc
