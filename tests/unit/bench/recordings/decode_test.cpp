// Decoding of logs: frames that are shorter or longer than their message, J1939, and the output formats.
#include "bench/recordings/decode.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "dbc/parser/parse.hpp"
#include "tests/own_folder.hpp"

namespace canhil::recordings {
namespace {

using testing::ElementsAre;

constexpr const char* plain_dbc = R"(BU_: A
BO_ 291 M: 8 A
 SG_ first : 0|8@1+ (0.1,0) [0|0] "V" A
 SG_ wide : 15|16@0+ (1,0) [0|0] "" A
 SG_ last : 56|8@1+ (1,0) [0|0] "" A
BO_ 292 P: 4 A
 SG_ page M : 16|8@1+ (1,0) [0|0] "" A
 SG_ one m1 : 0|8@1+ (1,0) [0|0] "" A
 SG_ two m2 : 24|8@1+ (1,0) [0|0] "" A
BO_ 293 U: 8 A
 SG_ count : 0|64@1+ (1,0) [0|0] "" A
VAL_ 293 count 18446744073709551615 "not available" ;
)";

dbc::Database database_of(const std::string& text) {
  auto database = dbc::parse_leniently(text, "t.dbc");
  EXPECT_TRUE(database) << database.error().message;
  return *database;
}

struct Decoded {
  std::string text;
  LeftOut left_out;
};

Decoded decoded(const std::string& dbc, const std::string& log, const DecodeOptions& options = {}) {
  const std::string path = test::own_folder() + "/decode.log";
  std::ofstream(path) << log;
  Decoded result;
  auto left_out =
      decode(path, database_of(dbc), options, [&](std::string_view part) { result.text += part; });
  EXPECT_TRUE(left_out) << left_out.error().message;
  if (left_out) result.left_out = std::move(*left_out);
  return result;
}

TEST(Decode, ReadsTheSignalsThatLieInsideAFrame) {
  const Decoded short_frame = decoded(plain_dbc, "(1.000000) can0 123#0300FF\n");
  EXPECT_EQ(short_frame.text, "    0.000000  can0 R M: first=0.3 V wide=255 last=missing\n");
  EXPECT_EQ(short_frame.left_out.short_frames, 1U);
  EXPECT_EQ(short_frame.left_out.missing, 1U);
  EXPECT_EQ(decoded(plain_dbc, "(1.000000) can0 123#0300\n").text,
            "    0.000000  can0 R M: first=0.3 V wide=missing last=missing\n");
  EXPECT_EQ(decoded(plain_dbc, "(1.000000) can0 123#\n").text,
            "    0.000000  can0 R M: first=missing wide=missing last=missing\n");
  const Decoded longer = decoded(plain_dbc, "(1.000000) can0 123##00300010000000000FFFFFFFF\n");
  EXPECT_EQ(longer.text, "    0.000000  can0 R M: first=0.3 V wide=1 last=0\n");
  EXPECT_EQ(longer.left_out.short_frames, 0U);
}

// Whether a multiplexed signal is missing can only be said if the multiplexor is there.
TEST(Decode, LeavesOutSignalsWhoseMultiplexorIsMissing) {
  EXPECT_EQ(decoded(plain_dbc, "(1.000000) can0 124#0507\n").text, "    0.000000  can0 R P: page=missing\n");
  EXPECT_EQ(decoded(plain_dbc, "(1.000000) can0 124#050702\n").text,
            "    0.000000  can0 R P: page=2 two=missing\n");
  EXPECT_EQ(decoded(plain_dbc, "(1.000000) can0 124#050701\n").text,
            "    0.000000  can0 R P: page=1 one=5\n");
}

TEST(Decode, WritesAllDigitsInEveryFormat) {
  const char* log = "(1.000000) can0 125#FFFFFFFFFFFFFFFF\n(2.500000) can0 123#03\n";
  EXPECT_EQ(decoded(plain_dbc, log).text,
            "    0.000000  can0 R U: count=18446744073709551615 (not available)\n"
            "    1.500000  can0 R M: first=0.3 V wide=missing last=missing\n");
  EXPECT_EQ(decoded(plain_dbc, log, {.format = Format::csv}).text,
            "t_s,bus,M.first,M.wide,M.last,U.count\n"
            "0.000000,can0,,,,18446744073709551615\n1.500000,can0,0.3,,,\n");
  EXPECT_EQ(decoded(plain_dbc, log, {.format = Format::json_lines}).text,
            R"({"t_s":0.000000,"bus":"can0","transmitted":false,"id":293,"message":"U","signals":)"
            R"({"count":18446744073709551615}})"
            "\n"
            R"({"t_s":1.500000,"bus":"can0","transmitted":false,"id":291,"message":"M","signals":)"
            R"({"first":0.3},"missing":["wide","last"]})"
            "\n");
}

TEST(Decode, JsonHasNullForWhatIsNotFinite) {
  const char* dbc =
      "BU_: A\nBO_ 1 F: 8 A\n SG_ x : 0|32@1- (1,0) [0|0] \"\" A\n SG_ y : 32|32@1- (1,0) [0|0] \"\" A\n"
      "SIG_VALTYPE_ 1 x : 1;\nSIG_VALTYPE_ 1 y : 1;\n";
  const auto line = nlohmann::json::parse(
      decoded(dbc, "(1.000000) can0 001#0000C07F000080FF\n", {.format = Format::json_lines}).text);
  EXPECT_TRUE(line["signals"]["x"].is_null());
  EXPECT_TRUE(line["signals"]["y"].is_null());
}

// Ids: 18FEF1xx is PDU2 of group 65265; 0C00xxyy is PDU1 of group 0 to the address xx.
constexpr const char* j1939_dbc = R"(BU_: A
BO_ 2566844926 CCVS1: 8 A
 SG_ Speed : 8|16@1+ (0.00390625,0) [0|250] "km/h" A
BO_ 2348875518 TSC1: 8 A
 SG_ Torque : 0|8@1+ (1,-125) [0|0] "%" A
BO_ 2566847744 OfEngine: 8 A
 SG_ a : 0|8@1+ (1,0) [0|0] "" A
BO_ 2566847747 OfBox: 8 A
 SG_ b : 0|8@1+ (1,0) [0|0] "" A
BO_ 291 Standard: 8 A
 SG_ s : 0|8@1+ (1,0) [0|0] "" A
)";
const std::string marked =
    std::string(j1939_dbc) + "BA_DEF_ \"ProtocolType\" STRING ;\nBA_ \"ProtocolType\" \"J1939\";\n";

TEST(J1939, FindsMessagesByTheirParameterGroup) {
  const auto line = [](const std::string& frame) {
    return decoded(marked, "(1.000000) can0 " + frame + "\n").text;
  };
  EXPECT_EQ(line("18FEF100#FF0010FFFFFFFFFF"), "    0.000000  can0 R from 0 CCVS1: Speed=16 km/h\n");
  EXPECT_EQ(line("0CFEF1FE#FF0010FFFFFFFFFF"), "    0.000000  can0 R from 254 CCVS1: Speed=16 km/h\n");
  EXPECT_EQ(line("0C000B03#80"), "    0.000000  can0 R from 3 to 11 TSC1: Torque=3 %\n");
  EXPECT_EQ(line("0CFEFD03#07"), "    0.000000  can0 R from 3 OfBox: b=7\n");
  EXPECT_EQ(line("123#07"), "    0.000000  can0 R Standard: s=7\n");
  EXPECT_EQ(line("18FEF200#FF"), "");
  EXPECT_EQ(line("19FEF100#FF"), "") << "another data page";
}

TEST(J1939, SeveralMessagesOfAGroupNeedTheSource) {
  const Decoded other = decoded(marked, "(1.000000) can0 18FEFD01#07\n");
  EXPECT_EQ(other.text, "");
  EXPECT_EQ(other.left_out.frames, 0U);
  EXPECT_EQ(other.left_out.ambiguous, 1U);
  EXPECT_THAT(other.left_out.ambiguous_ids, ElementsAre("18FEFD01"));
}

TEST(J1939, IsReadOnlyWhereTheDbcOrTheOptionSaysSo) {
  const char* log = "(1.000000) can0 18FEF100#FF0010FFFFFFFFFF\n(1.000000) can0 0C000B03#80\n";
  EXPECT_EQ(decoded(j1939_dbc, log).left_out.frames, 2U);
  EXPECT_EQ(decoded(j1939_dbc, log, {.j1939 = true}).left_out.frames, 0U);
  // The format of one message, against the default and the protocol.
  const std::string formats =
      "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\";\n"
      "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n";
  EXPECT_EQ(decoded(j1939_dbc + formats + "BA_ \"VFrameFormat\" BO_ 2566844926 3;\n", log).left_out.ids,
            std::set<std::string>{"0C000B03"});
  EXPECT_EQ(decoded(marked + formats + "BA_ \"VFrameFormat\" BO_ 2566844926 1;\n", log).left_out.ids,
            std::set<std::string>{"18FEF100"});
}

TEST(J1939, TheTableHasTheAddresses) {
  EXPECT_EQ(decoded(marked,
                    "(1.000000) can0 18FEF100#FF0010\n(2.000000) can0 0C000B03#80\n(3.000000) can0 123#07\n",
                    {.format = Format::csv})
                .text,
            "t_s,bus,source,destination,CCVS1.Speed,TSC1.Torque,Standard.s\n"
            "0.000000,can0,0,,16,,\n1.000000,can0,3,11,,3,\n2.000000,can0,,,,,7\n");
}

// PGN 65259 (component identification) has up to 39 bytes, which node 0x17 sends to all nodes (BAM).
constexpr const char* component_dbc = R"(BU_: A
BO_ 2566843390 ComponentId: 39 A
 SG_ first : 0|8@1+ (1,0) [0|0] "" A
 SG_ last : 304|8@1+ (1,0) [0|0] "" A
BA_DEF_ "ProtocolType" STRING ;
BA_ "ProtocolType" "J1939";
)";
std::string component_log(std::size_t missing = 0) {
  std::string log = "(1.000000) can0 18ECFF17#20270006FFEBFE00\n";
  for (std::size_t i = 1; i <= 6; ++i)
    if (i != missing) log += fmt::format("(1.{}00000) can0 18EBFF17#0{}4142434445464{}\n", i, i, i);
  return log;
}

TEST(J1939, PutsMessagesOfSeveralFramesTogether) {
  const Decoded whole = decoded(component_dbc, component_log());
  EXPECT_EQ(whole.text, "    0.600000  can0 R from 23 ComponentId: first=65 last=68\n");
  EXPECT_EQ(whole.left_out.frames, 0U);
  EXPECT_EQ(whole.left_out.incomplete, 0U);
  for (std::size_t missing = 1; missing <= 6; ++missing) {
    const Decoded lacking = decoded(component_dbc, component_log(missing));
    EXPECT_EQ(lacking.text, "") << missing;
    EXPECT_EQ(lacking.left_out.incomplete, 1U) << missing;
  }
}

TEST(J1939, MessageOfSeveralFramesThatTheDbcLacksIsLeftOut) {
  const Decoded other = decoded(marked, component_log());
  EXPECT_EQ(other.text, "");
  EXPECT_EQ(other.left_out.ids, std::set<std::string>{"18FEEB17"});
  EXPECT_EQ(other.left_out.frames, 1U);
}

TEST(J1939, FramesOfTheTransportProtocolMayBeMessagesToo) {
  const std::string both =
      std::string(component_dbc) + "BO_ 2565668862 TPCM: 8 A\n SG_ control : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(decoded(both, component_log()).text,
            "    0.000000  can0 R from 23 to 255 TPCM: control=32\n"
            "    0.600000  can0 R from 23 ComponentId: first=65 last=68\n");
}

// A gateway sends the message on two buses; the frames come alternately.
TEST(J1939, MessagesOfTwoInterfacesAreNotMixed) {
  std::string both, line;
  std::istringstream log(component_log());
  while (std::getline(log, line)) {
    both += line + "\n";
    both += line.replace(line.find("can0"), 4, "can1") + "\n";
  }
  const Decoded whole = decoded(component_dbc, both);
  EXPECT_EQ(whole.left_out.incomplete, 0U);
  EXPECT_EQ(std::ranges::count(whole.text, '\n'), 2);
}

TEST(J1939, OptionWithoutExtendedIdsIsAnError) {
  const auto result = decode("none.log", database_of(plain_dbc), {.j1939 = true}, [](std::string_view) {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message,
            "--j1939: the DBC has no message with a 29-bit id, expected at least one");
}

}  // namespace
}  // namespace canhil::recordings
