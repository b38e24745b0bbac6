#include "dbc/parser/parse.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>

namespace canhil::dbc {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Database parsed(std::string_view text) {
  auto database = parse(text, "test.dbc");
  EXPECT_TRUE(database) << database.error().message;
  return database.value_or(Database{});
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Parse, TheContract) {
  const auto database = read_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(database) << database.error().message;
  EXPECT_EQ(database->version, "1");
  std::size_t nodes = 0, messages = 0;
  std::ifstream file(SOURCE_DIR "/dbc/canhil.dbc");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("BU_: ")) nodes = static_cast<std::size_t>(std::ranges::count(line, ' '));
    if (line.starts_with("BO_ ")) ++messages;
  }
  EXPECT_EQ(database->nodes.size(), nodes);
  EXPECT_EQ(database->messages.size(), messages);
  const Message* message = find_message(*database, "SlaveImuDeltaTheta");
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message, find_message(*database, 128));
  EXPECT_EQ(message->sender, "SlaveImu");
  EXPECT_EQ(message->cycle_time_us, 10'000);
  EXPECT_EQ(message->e2e_data_id, 16512);
  EXPECT_EQ(message->sample_group, "SlaveImu");
  EXPECT_THAT(message->answers, IsEmpty());
  EXPECT_THAT(find_message(*database, "FixUpdate")->answers, ElementsAre("Ssbl", "Gps"));
  EXPECT_EQ(message->comment, "Integrated gyro output of the slave IMU.");
  const Signal* signal = find_signal(*message, "delta_theta_x_rad");
  ASSERT_NE(signal, nullptr);
  EXPECT_EQ(signal->start_bit, 12U);
  EXPECT_EQ(signal->length, 17U);
  EXPECT_EQ(signal->type, RawType::signed_integer);
  EXPECT_EQ(signal->byte_order, ByteOrder::little_endian);
  EXPECT_EQ(signal->scale, 2e-6);
  EXPECT_EQ(signal->minimum, -0.131);
  EXPECT_EQ(signal->unit, "rad");
  EXPECT_THAT(signal->receivers, ElementsAre("Target"));
  EXPECT_EQ(signal->sensor_sigma, 2.57e-6);
  EXPECT_TRUE(signal->carries_remainder);
  EXPECT_FALSE(find_signal(*message, "gyro_validity")->carries_remainder);
  EXPECT_THAT(find_signal(*message, "gyro_validity")->values,
              ElementsAre(ValueName{1, "valid"}, ValueName{0, "invalid"}));
  EXPECT_EQ(find_signal(*find_message(*database, "ParamSet"), "value")->type, RawType::float32);
}

class VectorStyle : public testing::Test {
 protected:
  const Database database = parsed(content_of(TEST_DATA_DIR "/dbc/vector_style.dbc"));
  const Message& motor = database.messages.at(0);
  const Message& request = database.messages.at(1);
};

TEST_F(VectorStyle, PseudoMessageIsDropped) { EXPECT_EQ(database.messages.size(), 2U); }

TEST_F(VectorStyle, ExtendedIdsHaveBit31InTheText) {
  EXPECT_TRUE(motor.extended);
  EXPECT_EQ(motor.id, 2566834709U & 0x7FFFFFFFU);
  EXPECT_EQ(find_message(database, motor.id, true), &motor);
  EXPECT_EQ(find_message(database, motor.id, false), nullptr);
}

TEST_F(VectorStyle, NobodyIsEmpty) {
  EXPECT_EQ(request.sender, "");
  EXPECT_THAT(request.further_senders, ElementsAre("Tester", "Display"));
  EXPECT_THAT(find_signal(motor, "temperature")->receivers, ElementsAre());
  EXPECT_THAT(find_signal(motor, "speed")->receivers, ElementsAre("Tester", "Display"));
}

TEST_F(VectorStyle, TextIsUtf8WithoutCarriageReturns) {
  EXPECT_EQ(find_signal(motor, "temperature")->unit,
            "\xC2\xB0"
            "C");
  EXPECT_EQ(database.nodes[0].comment, "Der gr\xC3\xB6\xC3\x9Fte Knoten");
  EXPECT_EQ(motor.comment, "State of the motor\nover two lines");
  EXPECT_EQ(database.comment,
            "A motor,\nas a tool of the trade writes it; \"quoted\" \xE2\x80\x93 and with a dash.");
}

TEST_F(VectorStyle, AttributesAndDefaults) {
  EXPECT_EQ(motor.cycle_time_us, 20'000);
  EXPECT_EQ(request.cycle_time_us, 0);
  const auto value = [&](const Attributes& own, Owner owner, std::string_view name) {
    const AttributeValue* found = find_attribute(database, own, owner, name);
    return found != nullptr ? *found : AttributeValue("none");
  };
  EXPECT_EQ(value(database.nodes[0].attributes, Owner::node, "Address"), AttributeValue(std::int64_t{16}));
  EXPECT_EQ(value(database.nodes[1].attributes, Owner::node, "Address"), AttributeValue(std::int64_t{254}));
  EXPECT_EQ(value(find_signal(motor, "speed")->attributes, Owner::signal, "Start"), AttributeValue(1000.0));
  EXPECT_EQ(value(database.attributes, Owner::network, "BusType"), AttributeValue("CAN"));
  EXPECT_EQ(value({}, Owner::signal, "Address"), AttributeValue("none"));
  ASSERT_EQ(database.relations.size(), 3U);
  EXPECT_EQ(database.relations[0].node, "Tester");
  EXPECT_EQ(database.relations[0].target, "speed");
  EXPECT_EQ(database.relations[0].value, AttributeValue(std::int64_t{100}));
  EXPECT_EQ(database.relations[1].message_id, 291U);
  EXPECT_EQ(database.relations[2].target, "ambient");
}

TEST_F(VectorStyle, EnvironmentVariables) {
  ASSERT_EQ(database.variables.size(), 2U);
  const EnvironmentVariable& ambient = database.variables[0];
  EXPECT_EQ(ambient.type, 1);
  EXPECT_EQ(ambient.minimum, -40);
  EXPECT_EQ(ambient.initial, 20);
  EXPECT_EQ(ambient.comment, "Air");
  EXPECT_THAT(ambient.nodes, ElementsAre("Tester"));
  const EnvironmentVariable& key = database.variables[1];
  EXPECT_EQ(key.data_size, 5U);
  EXPECT_THAT(key.values, ElementsAre(ValueName{0, "out"}, ValueName{1, "in"}));
  EXPECT_EQ(key.attributes.at("Kind"), AttributeValue("b"));
}

TEST_F(VectorStyle, SignalGroupsAndValueTables) {
  ASSERT_EQ(motor.groups.size(), 1U);
  EXPECT_EQ(motor.groups[0].name, "Mechanics");
  EXPECT_THAT(motor.groups[0].signals, ElementsAre("speed", "torque"));
  EXPECT_THAT(database.value_tables.at(0).values, ElementsAre(ValueName{1, "on"}, ValueName{0, "off"}));
}

TEST(Parse, MultiplexingSimpleAndExtended) {
  const auto database = read_file(TEST_DATA_DIR "/dbc/multiplexed.dbc");
  ASSERT_TRUE(database) << database.error().message;
  const Message& simple = *find_message(*database, "Simple");
  EXPECT_TRUE(find_signal(simple, "page")->multiplexor);
  EXPECT_EQ(find_signal(simple, "mode")->multiplexed_by, "page");
  EXPECT_THAT(find_signal(simple, "mode")->mux_ranges, ElementsAre(MuxRange{9, 9}));
  const Message& extended = *find_message(*database, "Extended");
  const Signal& inner = *find_signal(extended, "inner");
  EXPECT_TRUE(inner.multiplexor);
  EXPECT_EQ(inner.multiplexed_by, "top");
  EXPECT_THAT(find_signal(extended, "leaf_a")->mux_ranges, ElementsAre(MuxRange{0, 3}, MuxRange{5, 5}));
  EXPECT_TRUE(
      mutually_exclusive(extended, *find_signal(extended, "leaf_a"), *find_signal(extended, "other")));
  EXPECT_TRUE(
      mutually_exclusive(extended, *find_signal(extended, "leaf_a"), *find_signal(extended, "leaf_b")));
  EXPECT_FALSE(
      mutually_exclusive(extended, *find_signal(extended, "leaf_a"), *find_signal(extended, "rest")));
  EXPECT_FALSE(mutually_exclusive(extended, *find_signal(extended, "leaf_a"), inner));
}

TEST(Parse, FdFramesByTheirFormatAttribute) {
  const auto database = read_file(TEST_DATA_DIR "/dbc/fd.dbc");
  ASSERT_TRUE(database) << database.error().message;
  EXPECT_TRUE(database->messages[0].fd);
  EXPECT_EQ(database->messages[0].size, 64U);
  EXPECT_TRUE(database->messages[1].fd && database->messages[1].extended);
}

TEST(Parse, ByteOrdersSignsAndTypes) {
  const Database database = parsed(
      "BS_:\nBU_: A\nBO_ 1 M: 8 A\n SG_ a : 7|16@0- (-1E-3,2) [-1|+3] \"x\" A\nBO_ 2 D: 8 A\n"
      " SG_ d : 0|64@1- (1,0) [0|0] \"\" Vector__XXX\nSIG_VALTYPE_ 2 d 2;\n");
  const Signal& a = database.messages[0].signals[0];
  EXPECT_EQ(a.byte_order, ByteOrder::big_endian);
  EXPECT_TRUE(a.is_signed());
  EXPECT_EQ(a.scale, -1e-3);
  EXPECT_EQ(a.offset, 2);
  EXPECT_EQ(a.maximum, 3);
  EXPECT_EQ(database.messages[1].signals[0].type, RawType::float64);
}

TEST(Parse, BitTimingAndAnEmptyFile) {
  EXPECT_TRUE(parse("BS_: 500000 : 1,2\nBU_:\n", "x"));
  EXPECT_TRUE(parse("", "x"));
}

TEST(Parse, FilesThatAreNotThere) {
  const auto database = read_file("/nowhere/x.dbc");
  ASSERT_FALSE(database);
  EXPECT_EQ(database.error().message,
            "/nowhere/x.dbc: cannot be read (No such file or directory), expected a DBC file");
}

// FNV-1a's published vectors: "" and "foobar".
TEST(Hash, IsFnv1aWithoutCarriageReturns) {
  EXPECT_EQ(hash(""), 0xCBF29CE484222325U);
  EXPECT_EQ(hash("foobar"), 0x85944171F73967E8U);
  EXPECT_EQ(hash("foo\r\nbar"), hash("foo\nbar"));
  EXPECT_NE(hash("foobar"), hash("foobaz"));
}

TEST(RawRange, IsInsideOfTheLimitsAndOfTheBits) {
  const auto range = [](double scale, double offset, double minimum, double maximum, unsigned length,
                        RawType type) {
    Signal signal;
    signal.scale = scale;
    signal.offset = offset;
    signal.minimum = minimum;
    signal.maximum = maximum;
    signal.length = length;
    signal.type = type;
    const auto found = raw_range(signal);
    return found ? std::pair(found->lowest, found->highest) : std::pair(std::int64_t{1}, std::int64_t{0});
  };
  constexpr auto u = RawType::unsigned_integer;
  constexpr auto s = RawType::signed_integer;
  EXPECT_EQ(range(2e-5, 0, -1.31, 1.31, 17, s), std::pair(-65500L, 65500L));
  EXPECT_EQ(range(0.1, 0, -0.3, 0.3, 17, s), std::pair(-3L, 3L));  // 0.3 / 0.1 is just below 3
  EXPECT_EQ(range(3, 0, 1, 11, 8, u), std::pair(1L, 3L));
  EXPECT_EQ(range(1, 0, 0, 0, 8, u), std::pair(0L, 255L));
  EXPECT_EQ(range(1, 0, 0, 0, 8, s), std::pair(-128L, 127L));
  EXPECT_EQ(range(1, 0, -1000, 1000, 8, s), std::pair(-128L, 127L));
  EXPECT_EQ(range(-0.5, 10, 5, 10, 8, u), std::pair(0L, 10L));
  EXPECT_EQ(range(1, 0, 0, 0, 64, u), std::pair(0L, -1L));  // all 64 bits
  EXPECT_EQ(range(1, 0, 0, 0, 64, s), std::pair(INT64_MIN, INT64_MAX));
  EXPECT_EQ(range(1, 0, 0.2, 0.8, 8, u), std::pair(1L, 0L));  // no raw value
}

TEST(RealRange, IsFiniteAndOfTheRightEndOnANegativeScale) {
  Signal signal;
  signal.type = RawType::float32;
  EXPECT_EQ(real_range(signal).highest, std::numeric_limits<float>::max());
  signal.scale = -2;
  signal.offset = 1;
  signal.minimum = -9;
  signal.maximum = 3;
  EXPECT_EQ(real_range(signal).lowest, -1);
  EXPECT_EQ(real_range(signal).highest, 5);
}

// A range may end at any raw value of a 64-bit multiplexor; values from 2^63 on do not fit into a signed
// integer.
TEST(Parse, AMultiplexorsRangeMayEndWhereItsBitsDo) {
  const auto database = parse(
      "BS_:\nBU_: A\nBO_ 2 N: 12 A\n SG_ x M : 0|64@1+ (1,0) [0|0] \"\" A\n SG_ y m0 : 64|8@1+ (1,0) [0|0] "
      "\"\" A\n"
      "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"StandardCAN_FD\";\nBA_ \"VFrameFormat\" BO_ 2 1;\n"
      "SG_MUL_VAL_ 2 y x 3-9223372036854775808,9223372036854775809-18446744073709551615;",
      "t.dbc");
  ASSERT_TRUE(database) << database.error().message;
  EXPECT_EQ(database->messages[0].signals[1].mux_ranges,
            (std::vector<MuxRange>{{3, 9223372036854775808U}, {9223372036854775809U, UINT64_MAX}}));
}

std::string text_of_messages(int count) {
  std::string text = "BS_:\nBU_: A";
  for (int i = 0; i < count; ++i) text += " N" + std::to_string(i);
  text += "\nBA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 0;\n";
  for (int i = 0; i < count; ++i) {
    text += "BO_ " + std::to_string(2147483648U + static_cast<unsigned>(i)) + " M" + std::to_string(i) +
            ": 8 N" + std::to_string(i) + "\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\n";
  }
  for (int i = 0; i < count; ++i) {
    const std::string id = std::to_string(2147483648U + static_cast<unsigned>(i));
    text += fmt::format("BA_ \"GenMsgCycleTime\" BO_ {0} 10;\nVAL_ {0} s 0 \"zero\" 1 \"one\" ;\n", id);
  }
  return text;
}

double seconds_to_parse(const std::string& text) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    EXPECT_TRUE(parse(text, "t.dbc"));
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// 16 times as many messages take about 16 times as long. Nested loops over all messages would take 256 times
// as long. On a busy machine a single comparison is uncertain (a ratio of 73 was measured once), so the test
// makes up to three comparisons.
TEST(Parse, TakesAsLongAsTheTextIs) {
  const std::string few = text_of_messages(1'500), many = text_of_messages(24'000);
  double times = 256;
  for (int left = 3; left > 0 && times >= 64; --left) times = seconds_to_parse(many) / seconds_to_parse(few);
  EXPECT_LT(times, 64);
}

}  // namespace
}  // namespace canhil::dbc
