// Tests how hil-bench log convert, decode and replay treat the files of other tools, as a user starts them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <future>

#include "dbc/ports/local_bus.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string file(const std::string& name, const std::string& text) {
  std::string path = scratch(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

// A DBC with the message M (id 123 in hexadecimal digits), whose signal s is the first byte.
std::string dbc() {
  return file(
      "any.dbc",
      "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: A B\n\nBO_ 291 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" B\n");
}
const std::string frame = "(1.000000) can0 123#0500000000000000\n";
const std::string decoded = "    0.000000  can0 R M: s=5\n";

// A pipe cannot be opened twice; the table reads the log twice.
TEST(Pipe, IsDecoded) {
  const std::string log = file("pipe.log", frame),
                    command = fmt::format("{} decode /dev/stdin --dbc {}", HIL_BENCH, dbc());
  EXPECT_EQ(shell(fmt::format("cat {} | {}", log, command)).out, decoded);
  EXPECT_EQ(shell(fmt::format("gzip -c {} | {}", log, command)).out, decoded);
  EXPECT_EQ(shell(fmt::format("cat {} | {} --format csv", log, command)).out,
            "t_s,bus,M.s\n0.000000,can0,5\n");
}

TEST(Pipe, WithANameIsDecodedAndConverted) {
  const std::string fifo = scratch("fifo"), log = file("fifo.log", frame);
  ASSERT_EQ(shell("mkfifo " + fifo).code, 0);
  const auto read_from_fifo = [&](const std::string& command) {
    return shell(fmt::format("(cat {} >{} &) ; timeout 20 {} {}", log, fifo, HIL_BENCH, command));
  };
  EXPECT_EQ(read_from_fifo(fmt::format("decode {} --dbc {}", fifo, dbc())).out, decoded);
  EXPECT_EQ(read_from_fifo(fmt::format("log convert {} {}", fifo, scratch("of_fifo.log"))).code, 0);
  EXPECT_EQ(read(scratch("of_fifo.log")), "(1.000000) can0 123#0500000000000000 R\n");
}

TEST(Pipe, IsReplayedToTheDevice) {
  const std::string log = scratch("los.log");
  hil_bench(fmt::format("run {} --lockstep --log {}", scenario("los_quick"), log));
  const Ended of_file = hil_target("--replay " + log);
  ASSERT_EQ(of_file.code, 0) << of_file.err;
  const Ended of_pipe = shell(fmt::format("gzip -c {} | {} --replay /dev/stdin", log, HIL_TARGET));
  EXPECT_EQ(of_pipe.code, 0) << of_pipe.err;
  EXPECT_EQ(of_pipe.out, of_file.out);
}

TEST(Convert, SaysWhatItLeavesOut) {
  const std::string log =
      file("mixed.log", "# engine off\n" + frame + "(1.100000) can0 00321#81:05:11223344#DEADBEEF\n");
  const Ended ended = hil_bench(fmt::format("log convert {} {}", log, scratch("mixed.asc")));
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, HasSubstr("mixed.asc: 1 frames"));
  EXPECT_THAT(ended.err, HasSubstr("1 left out: lines that are not frames, such as comments; the first is"));
  EXPECT_THAT(ended.err, HasSubstr("1 left out: frames of CAN XL; the first is"));
}

// Every command that reads a log says what it did not read, once.
TEST(Log, WhatIsLeftOutIsSaidByEveryCommand) {
  const std::string log = scratch("commented.log"), own = scenario("los_quick");
  hil_bench(fmt::format("run {} --lockstep --log {}", own, scratch("whole.log")));
  std::ofstream(log) << "# engine off\n" << read(scratch("whole.log")) << "# engine on\n";
  const std::string of_log =
      "log '" + log + "': 2 left out: lines that are not frames, such as comments; the first is";
  for (const std::string& command :
       {fmt::format("check {} {}", log, own), fmt::format("diverge {} {}", log, scratch("whole.log")),
        fmt::format("log compare {} {}", log, scratch("whole.log")),
        fmt::format("decode {} --dbc {}", log, dbc())}) {
    const Ended ended = hil_bench(command);
    EXPECT_NE(ended.code, 2) << command << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("hil-bench: " + of_log)) << command;
    EXPECT_EQ(ended.err.find("such as comments"), ended.err.rfind("such as comments")) << command;
  }
  for (const std::string& option : {"--replay " + log, "--bus log:" + log})
    EXPECT_THAT(hil_target(option).err, HasSubstr("hil-target: " + of_log)) << option;
}

TEST(Convert, ChoosesTheFormatByOptionOrEnding) {
  const std::string log = file("for_formats.log", frame);
  EXPECT_EQ(hil_bench(fmt::format("log convert {} {} --format asc", log, scratch("named.xyz"))).code, 0);
  EXPECT_THAT(read(scratch("named.xyz")), testing::StartsWith("date "));
  expect_one_line(hil_bench(fmt::format("log convert {} {} --format trc", log, scratch("refused"))),
                  "--format");
  expect_one_line(hil_bench(fmt::format("log convert {} {}", log, scratch("refused.xyz"))),
                  "its ending names no format");
  EXPECT_FALSE(std::filesystem::exists(scratch("refused.xyz")));
}

TEST(Convert, RefusesWhatIsNoLog) {
  const std::string note = file("note.log", "// a note of somebody\nint main() { return 0; }\n");
  expect_one_line(hil_bench(fmt::format("log convert {} {}", note, scratch("of_note.log"))), "is not a log");
  EXPECT_FALSE(std::filesystem::exists(scratch("of_note.log")));
  expect_one_line(hil_bench(fmt::format("decode {} --dbc {}", note, dbc())), "is not a log");
}

// python-can converts its database into a log that canhil reads, with the command that the message states.
TEST(Convert, NamesTheCommandThatConverts) {
  const std::string database = scratch("python.db"), log = file("for_python.log", frame);
  ASSERT_EQ(shell(fmt::format("/usr/bin/python3 -m can.logconvert {} {}", log, database)).code, 0);
  const Ended ended = hil_bench(fmt::format("log convert {} {}", database, scratch("of_database.asc")));
  const std::size_t from = ended.err.find("python3 -m"), to = ended.err.rfind(" (Debian");
  ASSERT_NE(from, std::string::npos) << ended.err;
  ASSERT_EQ(shell("/usr/bin/" + ended.err.substr(from, to - from)).code, 0);
  EXPECT_THAT(read(database + ".log"), HasSubstr("123#0500000000000000"));
}

TEST(Replay, OfSeveralInterfacesAsksForOne) {
  const std::string log = file("two.log", "(1.000000) can0 123#11\n(1.010000) can1 123#22\n");
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x", log)),
                  "the frames are of 2 interfaces, expected --channel with one of them, or --channel "
                  "INTERFACE=BUS for some of "
                  "them; the log has frames of: can0, can1");
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x --channel can2", log)),
                  "expected an interface of the log");
  expect_one_line(hil_bench(fmt::format("replay {}", log)), "--bus or --channel INTERFACE=BUS is missing");
  expect_one_line(hil_bench(fmt::format("replay {} --channel can0", log)),
                  "expected INTERFACE=BUS, or --bus");
  expect_one_line(hil_bench(fmt::format("replay {} --channel can0=local:x --channel can1=local:x", log)),
                  "is the second");
}

TEST(Replay, SendsTheFramesOfEachInterfaceToItsBus) {
  const std::string log =
      file("mapped.log", "(1.000000) can0 123#11\n(1.010000) can1 123#22\n(1.020000) can2 123#33\n");
  const auto name = [](const char* which) {
    return fmt::format("local:{}-{}", which,
                       std::filesystem::path(scratch("x")).parent_path().filename().string());
  };
  const auto first = host_local_bus(name("a"), {.node_name = "test"}, {}),
             second = host_local_bus(name("b"), {.node_name = "test"}, {});
  ASSERT_TRUE(first && second);
  auto ended = std::async(std::launch::async, [&] {
    return hil_bench(
        fmt::format("replay {} --bus {} --channel can1 --channel can2={}", log, name("a"), name("b")));
  });
  std::vector<int> on_first, on_second;
  const auto hear = [](Port& port, std::vector<int>& bytes) {
    wait(port, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 5'000'000);
    while (const auto received = port.receive()) bytes.push_back(received->frame.data[0]);
  };
  do {
    hear(**first, on_first);
    hear(**second, on_second);
  } while (ended.wait_for(std::chrono::seconds(0)) != std::future_status::ready);
  hear(**first, on_first);
  hear(**second, on_second);
  const Ended replayed = ended.get();
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, testing::StartsWith("2 frames on "));
  EXPECT_THAT(on_first, testing::ElementsAre(0x22));
  EXPECT_THAT(on_second, testing::ElementsAre(0x33));
}

}  // namespace
}  // namespace canhil::test
