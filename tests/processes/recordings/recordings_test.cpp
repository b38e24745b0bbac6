// Tests what hil-bench can do with recorded frames: judge them again, convert them to formats that other
// programs read and write, decode them, and send them again.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <sstream>

#include "dbc/logs/log.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::string file(const std::string& name, const std::string& text) {
  std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<LogEntry> entries_of(const std::string& log) {
  std::vector<LogEntry> entries;
  auto reader = LogReader::open(log);
  EXPECT_TRUE(reader) << reader.error().message;
  for (;;) {
    auto entry = reader->next();
    EXPECT_TRUE(entry) << entry.error().message;
    if (!entry || !*entry) return entries;
    entries.push_back(std::move(**entry));
  }
}

// The log of a run in lockstep. The run is flown once for all tests of this process.
const std::string& recorded() {
  static const std::string log = [] {
    std::string path = scratch("los.log");
    hil_bench(fmt::format("run {} --lockstep --log {} --json {}", scenario("los_quick"), path,
                          scratch("los.json")));
    return path;
  }();
  return log;
}

void convert(const std::string& from, const std::string& to) {
  const Ended ended = hil_bench(fmt::format("log convert {} {}", from, to));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr(fmt::format("{}: ", to)));
}

Ended others(const std::string& arguments) {
  return shell(
      fmt::format("/usr/bin/python3 {}/tests/processes/recordings/others.py {}", SOURCE_DIR, arguments));
}

// The frames of a log in the text format of others.py.
std::string frames_in_words(const std::string& log) {
  std::string text;
  for (const LogEntry& entry : entries_of(log)) {
    const Frame& frame = entry.frame;
    std::string flags, data;
    for (const auto& [letter, there] :
         {std::pair('x', frame.extended), std::pair('e', frame.error), std::pair('f', frame.fd),
          std::pair('b', frame.brs), std::pair('s', frame.esi)})
      if (there) flags += letter;
    for (const std::uint8_t byte : frame.payload()) data += fmt::format("{:02x}", byte);
    text += fmt::format("{} {:X} {} {}\n", entry.t_ns / 1000, frame.id, flags.empty() ? "-" : flags,
                        data.empty() ? "-" : data);
  }
  return text;
}

// A log with a frame of each kind that all formats support. The first frame has a time in whole milliseconds,
// because python-can writes the start time of an ASC file with a resolution of 1 ms.
std::string all_kinds() {
  return file("kinds.log",
              "(1790000000.123000) can0 7FF#0011223344556677 T\n(1790000000.123001) can1 101#00 R\n"
              "(1790000001.000000) can0 1FFFFFFF#010203 R\n"
              "(1790000002.500000) can0 123##7000102030405060708090A0B R\n"
              "(1790000002.500001) can0 00012345##4000102030405060708090A0B0C0D0E0F T\n");
}

std::map<std::string, std::string> measured(const nlohmann::json& report) {
  std::map<std::string, std::string> all;
  for (const auto& check : report["checks"])
    all[check["name"]] = std::string(check["outcome"]) + " " + std::string(check["measured"]);
  return all;
}

class Recorded : public testing::TestWithParam<const char*> {};

// Records a flight in each format, and judges each recording again. There are flights in open loop, in closed
// loop, and with four estimators at once.
TEST_P(Recorded, IsJudgedAsItWasFlown) {
  const std::string flight = scenario(GetParam());
  for (const char* ending : {"log", "pcap", "asc", "blf"}) {
    const std::string log = scratch(fmt::format("{}.{}", GetParam(), ending)), flown = log + ".flown.json",
                      again = log + ".json";
    const int code = hil_bench(fmt::format("run {} --lockstep --log {} --json {}", flight, log, flown)).code;
    const Ended ended = hil_bench(fmt::format("check {} {} --json {}", log, flight, again));
    EXPECT_EQ(ended.code, code) << ended.out << ended.err;
    EXPECT_EQ(measured(read_json(again)), measured(read_json(flown)));
  }
}
INSTANTIATE_TEST_SUITE_P(Flights, Recorded,
                         testing::Values("los_closed_loop", "transfer_alignment_quick", "inflight_quick",
                                         "all_four"));

TEST(Check, InRealTimeGivesTheSameOutputsAndNoTiming) {
  const std::string log = scratch("real.log"), flown = scratch("flown.json"), again = scratch("again.json");
  const std::string flight = scenario("transfer_alignment_quick");
  hil_bench_whole(fmt::format("run {} --log {} --json {}", flight, log, flown), flown);
  EXPECT_EQ(hil_bench(fmt::format("check {} {} --json {}", log, flight, again)).code, 3);
  const auto before = measured(read_json(flown)), after = measured(read_json(again));
  for (const char* name : {"error attitude.heading", "consistency innovation.nis", "counters"})
    EXPECT_EQ(after.at(name), before.at(name));
  EXPECT_THAT(after.at("latency AlignAttitude"), HasSubstr("not measured a recording does not say"));
}

TEST(Check, WithFaultsKnowsWhatTheyDid) {
  const std::string faults =
      file("faults.toml", "[[fault]]\nkind = 'lost'\nnode = 'seeker'\nfrom_s = 2\nto_s = 2.05\n");
  const std::string log = scratch("lost.log"), flight = scenario("los_quick");
  hil_bench(fmt::format("run {} --faults {} --lockstep --log {}", flight, faults, log));
  const Ended ended = hil_bench(fmt::format("check {} {} --faults {}", log, flight, faults));
  EXPECT_THAT(ended.out, HasSubstr("fault 'lost seeker' of the bus: struck"));
  expect_one_line(hil_bench(fmt::format("check {} {}", log, flight)), "is not of");
}

TEST(Check, ABarThatIsTightenedFails) {
  std::string text = read(scenario("los_quick"));
  const std::string tight =
      file("tight.toml",
           text + "\n[[check]]\nkind = \"error\"\nquantity = \"los.rate.pitch\"\nbelow_mradps = 1e-6\n");
  const Ended ended = hil_bench(fmt::format("check {} {}", recorded(), tight));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
}

TEST(Check, AnotherRunIsRefusedInOneLine) {
  const std::string flight = scenario("los_quick");
  expect_one_line(hil_bench(fmt::format("check {} {} --seed 99", recorded(), flight)), "is not of");
  expect_one_line(hil_bench(fmt::format("check {} {}", recorded(), scenario("inflight_quick"))), "is not of");
  expect_one_line(hil_bench(fmt::format("check {} {}", file("empty.log", ""), flight)),
                  "no frame of the bench");
  expect_one_line(hil_bench(fmt::format("check none.log {}", flight)), "cannot read log 'none.log'");
}

TEST(Convert, RoundTripsKeepEveryFrame) {
  for (const std::string& log : {all_kinds(), recorded()}) {
    convert(log, scratch("a.asc"));
    convert(scratch("a.asc"), scratch("b.log"));
    EXPECT_EQ(read(scratch("b.log")), read(log));
    convert(log, scratch("a.blf"));
    convert(scratch("a.blf"), scratch("b.log"));
    EXPECT_EQ(read(scratch("b.log")), read(log));
    convert(log, scratch("c.pcap"));
    convert(scratch("c.pcap"), scratch("d.log"));
    EXPECT_EQ(frames_in_words(scratch("d.log")), frames_in_words(log)) << "without names and directions";
  }
}

TEST(Recorded, TheStampsOfALockstepRunAreItsVirtualTime) {
  std::optional<std::pair<std::int64_t, std::uint64_t>> first;
  std::int64_t span_us = 0, last_ns = 0;
  for (const LogEntry& entry : entries_of(recorded())) {
    if (first) {
      EXPECT_GE(entry.t_ns, last_ns) << "the log is in order";
    }
    last_ns = entry.t_ns;
    if (entry.frame.id != messages::Sync::info.id) continue;
    const std::uint64_t t_us = from_frame<messages::Sync>(entry.frame).time_us;
    if (!first) first = {entry.t_ns, t_us};
    span_us = static_cast<std::int64_t>(t_us - first->second);
    ASSERT_NEAR(static_cast<double>(entry.t_ns - first->first), 1e3 * static_cast<double>(span_us), 1000);
  }
  EXPECT_GT(span_us, 0);
}

TEST(Convert, RefusesWhatItCannotDoAndLeavesNothing) {
  const std::string bad =
      file("bad.asc", "date Sat Sep 30 15:06:13 2017\nbase hex  timestamps absolute\n0.1 1  800 Rx d 0\n");
  expect_one_line(hil_bench(fmt::format("log convert {} {}", bad, scratch("new.log"))),
                  "bad.asc:3: expected an id");
  EXPECT_FALSE(fs::exists(scratch("new.log")));
  expect_one_line(hil_bench(fmt::format("log convert {} {}", bad, bad)), "bad.asc");
  for (const char* ending : {"xyz", "mf4", "trc"}) {
    const std::string other = scratch(std::string("new.") + ending);
    expect_one_line(hil_bench(fmt::format("log convert {} {}", all_kinds(), other)),
                    "expected .log (candump), .asc, .blf or .pcap");
    EXPECT_FALSE(std::filesystem::exists(other));
    expect_one_line(hil_bench(fmt::format("run {} --bus in-process --log {}", scenario("los_quick"), other)),
                    "expected .log (candump), .asc, .blf or .pcap");
  }
  expect_one_line(hil_bench("log"), "subcommand");
}

TEST(PythonCan, ReadsWhatWeWrite) {
  convert(all_kinds(), scratch("ours.asc"));
  for (const std::string& log : {all_kinds(), scratch("ours.asc")}) {
    const Ended ended = others("frames " + log);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, frames_in_words(all_kinds())) << log;
  }
}

TEST(PythonCan, WritesWhatWeRead) {
  for (const char* ending : {"asc", "log"}) {
    const std::string theirs = scratch(std::string("theirs.") + ending);
    const Ended ended = others(fmt::format("copy {} {}", all_kinds(), theirs));
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(frames_in_words(theirs), frames_in_words(all_kinds())) << ending;
  }
}

TEST(Tshark, DecodesOurCaptures) {
  const std::string capture = scratch("ours.pcap");
  convert(all_kinds(), capture);
  const Ended ended =
      shell(fmt::format("tshark -r {} -T fields -E separator=, -e frame.time_epoch -e can.id -e "
                        "can.flags.xtd -e can.len -e data",
                        capture));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out,
            "1790000000.123000000,2047,0,8,0011223344556677\n"
            "1790000000.123001000,257,0,1,00\n"
            "1790000001.000000000,536870911,1,3,010203\n"
            "1790000002.500000000,291,0,12,000102030405060708090a0b\n"
            "1790000002.500001000,74565,1,16,000102030405060708090a0b0c0d0e0f\n");
}

TEST(Tshark, WritesWhatWeRead) {
  const std::string capture = scratch("for_tshark.pcap");
  convert(all_kinds(), capture);
  for (const char* format : {"pcapng", "nsecpcap", "pcap"}) {
    const std::string theirs = scratch(fmt::format("{}.pcap", format)), back = theirs + ".log";
    const Ended ended = shell(fmt::format("tshark -r {} -F {} -w {}", capture, format, theirs));
    ASSERT_EQ(ended.code, 0) << ended.err;
    convert(theirs, back);
    EXPECT_EQ(frames_in_words(back), frames_in_words(all_kinds())) << format;
  }
}

TEST(Decode, SaysWhatCanmatrixSays) {
  const std::string dbc = SOURCE_DIR "/dbc/canhil.dbc";
  const Ended ours = hil_bench(fmt::format("decode {} --dbc {} --format jsonl", recorded(), dbc));
  ASSERT_EQ(ours.code, 0) << ours.err;
  const Ended theirs = others(fmt::format("values {} {}", recorded(), dbc));
  ASSERT_EQ(theirs.code, 0) << theirs.err;
  const auto our_lines = lines_of(ours.out), their_lines = lines_of(theirs.out);
  ASSERT_EQ(our_lines.size(), their_lines.size());
  ASSERT_GT(our_lines.size(), 5000U);
  for (std::size_t i = 0; i < our_lines.size(); ++i) {
    const nlohmann::json frame = json_of(our_lines[i]);
    std::istringstream words(their_lines[i]);
    std::string name;
    words >> name;
    ASSERT_EQ(frame["message"], name);
    std::size_t values = 0;
    for (std::string word; words >> word; ++values) {
      const std::size_t equals = word.find('=');
      const double own = frame["signals"][word.substr(0, equals)];
      ASSERT_EQ(own, std::strtod(word.c_str() + equals + 1, nullptr)) << our_lines[i];
    }
    ASSERT_EQ(values, frame["signals"].size());
  }
}

TEST(Decode, ATableHasAColumnASignalAndARowAFrame) {
  const Ended ended = hil_bench(
      fmt::format("decode {} --dbc {}/dbc/canhil.dbc --format csv --only SeekerRange --only Sync --out {}",
                  recorded(), SOURCE_DIR, scratch("table.csv")));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto rows = lines_of(read(scratch("table.csv")));
  EXPECT_THAT(rows.front(), testing::StartsWith("t_s,bus,SeekerRange.e2e_crc,"));
  EXPECT_THAT(rows.front(), HasSubstr(",Sync.time_us"));
  const auto cells = [](const std::string& row) { return std::ranges::count(row, ','); };
  for (const std::string& row : rows) EXPECT_EQ(cells(row), cells(rows.front()));
  const auto entries = entries_of(recorded());
  EXPECT_EQ(
      rows.size() - 1, static_cast<std::size_t>(std::ranges::count_if(entries, [](const LogEntry& entry) {
        return entry.frame.id == messages::SeekerRange::info.id || entry.frame.id == messages::Sync::info.id;
      })));
}

TEST(Decode, SaysWhatItLeavesOut) {
  const std::string log = file("strange.log", "(1.000000) can0 7FE#00 R\n(1.500000) can0 0A0#00 R\n");
  const Ended ended = hil_bench(fmt::format("decode {} --dbc {}/dbc/canhil.dbc", log, SOURCE_DIR));
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, HasSubstr("=missing"));
  EXPECT_THAT(ended.err, testing::StartsWith("hil-bench: 1 frame left out, of no message: 7FE\n"
                                             "hil-bench: 1 frame shorter than the message, "));
  expect_one_line(hil_bench(fmt::format("decode {} --dbc {}/dbc/canhil.dbc --only Nothing", log, SOURCE_DIR)),
                  "--only 'Nothing': the DBC has no such message");
  expect_one_line(hil_bench(fmt::format("decode {} --dbc none.dbc", log)), "none.dbc");
}

// The clock of b is 5 s ahead of the clock of a. Four frames with the id 123 are in both logs. In b, their
// stamps are later by 5 s plus 100, 300, 200 and 200 us. So the mean is 5 s plus 200 us, and the standard
// deviation is sqrt((100^2 + 100^2) / 3) = 81.6 us. The frame with the data 03 is only in a, and the frame
// with the data 06 is only in b. The frame with the data FF was sent before a begins.
TEST(LogCompare, ReportsHowFarStampsAreApart) {
  const std::string a =
      file("a.log",
           "(100.000000) can0 123#01\n(100.010000) can0 123#02\n(100.020000) can0 123#03\n"
           "(100.030000) can0 300#AA\n(100.040000) can0 123#04\n(100.050000) can0 123#05\n");
  const std::string b = file("b.log",
                             "(104.000000) can1 123#FF\n(105.000100) can1 123#01\n(105.010300) can1 123#02\n"
                             "(105.030200) can1 300#AA\n(105.040200) can1 123#04\n(105.045000) can1 123#06\n"
                             "(105.050200) can1 123#05\n");
  const Ended ended = hil_bench(fmt::format("log compare {} {} --dbc {}/dbc/canhil.dbc", a, b, SOURCE_DIR));
  EXPECT_EQ(ended.code, 1) << ended.err;
  const auto lines = lines_of(ended.out);
  ASSERT_EQ(lines.size(), 5U) << ended.out;
  EXPECT_THAT(lines[1], testing::MatchesRegex("123 +4 +5000200.0 +81.6 +5000100.0 +5000300.0 +1 +1"));
  EXPECT_THAT(lines[2],
              testing::MatchesRegex("TargetHeartbeat +1 +5000200.0 +0.0 +5000200.0 +5000200.0 +0 +0"));
  EXPECT_THAT(lines[3], testing::MatchesRegex("all +5 +5000200.0 +70.7 +.* 1 +1"));
  EXPECT_EQ(lines[4], "1 frames were recorded while the other log did not record");
  const auto json = json_of(hil_bench(fmt::format("log compare {} {} --json -", b, a)).out);
  EXPECT_NEAR(json["all"]["mean_s"].get<double>(), -5.0002, 1e-9);
  EXPECT_EQ(json["messages"][0]["only_in_b"], 1);
  EXPECT_EQ(json["outside"], 1);
}

// Twenty frames with equal content are sent; log `a` does not contain one of them.
TEST(LogCompare, PairsRepeatedFramesByTheirTimes) {
  std::string a, b;
  for (int i = 0; i < 20; ++i) {
    if (i != 7) a += fmt::format("(100.{:02}0000) can0 123#01\n", i);
    b += fmt::format("(100.{:02}0100) can1 123#01\n", i);
  }
  const auto json = json_of(
      hil_bench(fmt::format("log compare {} {} --json -", file("a.log", a), file("b.log", b))).out)["all"];
  EXPECT_EQ(json["count"], 19);
  EXPECT_EQ(json["only_in_b"], 1);
  EXPECT_NEAR(json["max_s"].get<double>(), 100e-6, 1e-9);
  EXPECT_NEAR(json["sd_s"].get<double>(), 0, 1e-9);
}

TEST(LogCompare, OfTheSameAndOfNothing) {
  EXPECT_EQ(hil_bench(fmt::format("log compare {} {}", recorded(), file("again.log", read(recorded())))).code,
            0);
  const std::string one = file("one.log", "(100.000000) can0 123#01\n");
  EXPECT_EQ(
      hil_bench(fmt::format("log compare {} {}", one, file("two.log", "(100.000000) can0 456#01\n"))).code,
      3);
  expect_one_line(hil_bench(fmt::format("log compare {} {}", one, file("empty.log", ""))),
                  "no frame, expected a recording");
  expect_one_line(hil_bench(fmt::format("log compare {} {}", one, one)), "is named twice");
}

// The replay is ten times as fast as the recording. It uses an embedded bus that the test hosts.
TEST(Replay, SendsTheFramesAgainAtTheirTimes) {
  const std::string bus =
      fmt::format("local:replay-{}", fs::path(scratch("x")).parent_path().filename().string());
  auto hub = host_local_bus(bus, {.node_name = "test"}, {});
  ASSERT_TRUE(hub) << hub.error().message;
  auto ended = std::async(std::launch::async, [&] {
    return hil_bench(
        fmt::format("replay {} --bus {} --speed 10 --only 0A0 --only 70 --direction sent", recorded(), bus));
  });
  std::vector<Frame> expected;
  for (const LogEntry& entry : entries_of(recorded())) {
    if (entry.transmitted &&
        (entry.frame.id == messages::Sync::info.id || entry.frame.id == messages::SeekerAntenna::info.id))
      expected.push_back(entry.frame);
  }
  std::vector<Frame> got;
  while (ended.wait_for(std::chrono::seconds(0)) != std::future_status::ready ||
         wait(**hub, WaitFor::frame, 0)) {
    wait(**hub, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 10'000'000);
    while (const auto received = (*hub)->receive()) got.push_back(received->frame);
  }
  const Ended replayed = ended.get();
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr(fmt::format("{} frames on {}; late by", expected.size(), bus)));
  EXPECT_EQ(got, expected);
}

TEST(Replay, BadInputIsOneLine) {
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x --only 7G", recorded())),
                  "--only '7G': expected an id");
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x --only 7FE", recorded())),
                  "has no frame to send");
  expect_one_line(hil_bench("replay none.log --bus local:x"), "cannot read log 'none.log'");
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x --channel can0", all_kinds())),
                  "cannot carry a frame with id 123");
  expect_one_line(hil_bench(fmt::format("replay {} --bus none0", recorded())), "none0");
  expect_one_line(hil_bench(fmt::format("replay {} --bus local:x --speed 0", recorded())), "--speed");
}

}  // namespace
}  // namespace canhil::test
