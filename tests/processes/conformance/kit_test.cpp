// Tests the kit for user-written targets: the examples in C and in Python send the same bits, a run with each
// example reaches a verdict, and the tables of the kit match the DBC.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <regex>

#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

const std::string kit = SOURCE_DIR "/docs/examples/kit/";
const std::string in_python = "/usr/bin/python3 -B " + kit + "los_rate.py";

TEST(Kit, TablesAreThoseOfTheContract) {
  for (const auto& [option, file] :
       {std::pair("--c", "canhil_messages.h"), std::pair("--python", "canhil_messages.py")}) {
    const Ended made = shell(fmt::format("{} {}/dbc/canhil.dbc {}", DBCGEN, SOURCE_DIR, option));
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(made.out == read(kit + file)) << fmt::format(
        "dbc/canhil.dbc has changed: dbcgen dbc/canhil.dbc {} -o docs/examples/kit/{}", option, file);
  }
}

TEST(Kit, TablesAreRefusedForWhatTheyCannotSay) {
  expect_one_line(shell(fmt::format("{} {}/dbc/canhil-fd.dbc --c", DBCGEN, SOURCE_DIR)),
                  "expected classic CAN of at most 8 bytes");
  expect_one_line(shell(fmt::format("{} {}/dbc/motorola.dbc --python", DBCGEN, TEST_DATA_DIR)),
                  "motorola.dbc:");
}

class KitExample : public testing::TestWithParam<const char*> {
 protected:
  static std::string target() { return GetParam() == std::string("C") ? KIT_LOS_RATE : in_python; }
};

TEST_P(KitExample, FliesToAVerdict) {
  const std::string report = scratch(fmt::format("kit_{}.json", GetParam()));
  const Ended ended = hil_bench(
      fmt::format("run {} --bus {} --target '{}' --json {}", scenario("los_quick"), bus(), target(), report));
  expect_outputs_passed(ended, read_json(report));
}

TEST_P(KitExample, SaysInOneLineWhyItDoesNotStart) {
  expect_one_line(shell(target() + " --bus local:nobody-hosts-this"), "local:nobody-hosts-this");
  expect_one_line(shell(target() + " --bus no_such_interface"), "no_such_interface");
}

INSTANTIATE_TEST_SUITE_P(Languages, KitExample, testing::Values("C", "Python"),
                         [](const auto& named) { return named.param; });

TEST(Kit, CAndPythonAnswerWithTheSameBits) {
  std::string logs;
  for (const std::string& target : {std::string(KIT_LOS_RATE), in_python}) {
    const std::string log = scratch(fmt::format("kit{}.log", logs.size()));
    const Ended ended = hil_bench(
        fmt::format("run {} --lockstep --target '{}' --log {}", scenario("los_quick"), target, log));
    EXPECT_EQ(ended.code, 3) << ended.out << ended.err;  // timing is not measured in lockstep
    EXPECT_GT(target_frames(log).size(), 1000U);
    logs += " " + log;
  }
  EXPECT_THAT(hil_bench("diverge" + logs).out, HasSubstr("same: "));
}

// The option --target may contain arguments of the target. If the target does not receive them, its answers
// differ from the recorded ones.
TEST(Kit, ArgumentsReachTheTarget) {
  const std::string folder = scratch("kit_golden");
  shell("rm -rf " + folder);
  EXPECT_EQ(hil_bench(fmt::format("golden record {} {} --target '{} --gain 3'", folder, scenario("los_quick"),
                                  in_python))
                .code,
            0);
  EXPECT_EQ(hil_bench(fmt::format("golden check {} --target '{} --gain 3'", folder, KIT_LOS_RATE)).code, 0);
  const Ended other = hil_bench(fmt::format("golden check {} --target '{}'", folder, in_python));
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.out, HasSubstr("LosRate"));
}

const std::string own_target = read(SOURCE_DIR "/docs/own-target.md");

// If the host stalls, the bench repeats commands. In this case the test records the handshake again.
TEST(Documentation, HandshakeIsThatOfARun) {
  const std::string log = scratch("handshake.log");
  Ended annotated;
  for (int attempt = 0; attempt < 5; ++attempt) {
    hil_bench(
        fmt::format("run {} --lockstep --target '{}' --log {}", scenario("los_quick"), KIT_LOS_RATE, log));
    annotated = shell(fmt::format("/usr/bin/python3 -B {}/tests/processes/conformance/annotate.py {} {} 47",
                                  SOURCE_DIR, kit, log));
    if (own_target.find(annotated.out) != std::string::npos) break;
  }
  EXPECT_THAT(annotated.out, HasSubstr("StepDone: step 1"));
  EXPECT_THAT(own_target, HasSubstr("```\n" + annotated.out + "```\n"));
}

TEST(Documentation, CrcVectorsAreThoseOfTheCode) {
  const std::regex row(R"(\| (\w+) \| `([0-9A-F]{4})` \| `([0-9A-F]{14})` \| `([0-9A-F]{2})` \|)");
  int rows = 0;
  for (std::sregex_iterator at(own_target.begin(), own_target.end(), row), end; at != end; ++at, ++rows) {
    const auto number = [&](std::size_t field) { return std::stoull((*at)[field].str(), nullptr, 16); };
    const auto info = std::ranges::find(messages::all_messages, (*at)[1].str(), &MessageInfo::name);
    ASSERT_NE(info, messages::all_messages.end()) << at->str();
    EXPECT_EQ(info->e2e_data_id, number(2)) << at->str();
    std::array<std::uint8_t, 8> data{};
    for (std::size_t i = 1; i < data.size(); ++i)
      data[i] = static_cast<std::uint8_t>(number(3) >> (8 * (data.size() - 1 - i)));
    EXPECT_EQ(e2e::crc(data, info->e2e_data_id), number(4)) << at->str();
  }
  EXPECT_GE(rows, 5);
}

TEST(Documentation, ConformanceIsAsTheProgramPrintsIt) {
  const auto report = json_of(hil_bench(fmt::format("conformance --target {} --json -", KIT_LOS_RATE)).out);
  for (const auto& rule : report["rules"])
    EXPECT_THAT(own_target, HasSubstr(fmt::format("  PASS  {:<13}  {}\n", rule["id"].get<std::string>(),
                                                  rule["text"].get<std::string>())));
}

}  // namespace
}  // namespace canhil::test
