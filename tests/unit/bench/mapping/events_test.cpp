// Events of a scenario: how they are read, when they are sent, and how their answers are judged.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <string>

#include "bench/checks/events.hpp"
#include "bench/drive/flight.hpp"
#include "bench/mapping/event_sender.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/flight_record.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

using checks::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;
using testing::Pair;
using transport::Bytes;

constexpr const char* event_dbc = R"(VERSION ""
NS_ :
BS_:
BU_: Bench Device
BO_ 100 In: 8 Bench
 SG_ Angle : 0|16@1- (0.01,0) [0|0] "deg" Device
BO_ 200 Out: 8 Device
 SG_ Roll : 0|16@1- (0.01,0) [0|0] "deg" Bench
 SG_ Warm : 16|1@1+ (1,0) [0|0] "" Bench
BO_ 300 Ask: 8 Bench
 SG_ AskBytes : 0|64@1+ (1,0) [0|0] "" Device
BO_ 301 Tell: 8 Device
 SG_ TellBytes : 0|64@1+ (1,0) [0|0] "" Bench
BO_ 302 Mode: 4 Bench
 SG_ Power : 0|8@1+ (1,0) [0|0] "" Device
 SG_ Level : 8|16@1+ (0.5,0) [0|0] "" Device
)";
constexpr const char* event_mapping = R"(dbc = "ecu.dbc"
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Angle" = "master_ins.roll"
[[hear]]
message = "Out"
answers = "In"
signals = { Roll = "attitude.roll" }
flags = { Warm = "warm" }
[channels.diagnosis]
request = "Ask"
response = "Tell"
transport = "iso_tp"
[channels.mode]
request = "Mode"
transport = "frame"
)";
constexpr const char* event_scenario = R"(title = "t"
duration_s = 10.0
seed = 1
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 48.0
longitude_deg = 11.0
height_m = 500.0
trajectory = "s_path"
speed_mps = 15.0
heading_deg = 0
heading_amplitude_deg = 40
turn_period_s = 10.0
[master_ins]
period_ms = 20
[[check]]
kind = "error"
quantity = "attitude.roll"
below_deg = 1
)";

Result<scenario::Scenario> with(const std::string& events, const std::string& mapping = event_mapping) {
  return read_mapped(event_scenario + events, mapping, event_dbc);
}
std::string wrong(const std::string& event) {
  const auto read = with("[[event]]\n" + event);
  return read ? "" : read.error().message;
}

// What happens on a bus without time: the target answers at once.
class EventTalk {
 public:
  explicit EventTalk(const std::string& events) : EventTalk(with(events)) {}
  explicit EventTalk(Result<scenario::Scenario> read)
      : scenario_(std::move(*read)),
        mapping_(dynamic_cast<const Mapping&>(*scenario_.binding)),
        flight_(*drive_flight()),
        dialogue_(mapping_, scenario_.events) {}

  /// `answer`: the target's frames to a frame of the bench.
  void run(scenario::Phase phase, std::int64_t end_us,
           const std::function<std::vector<Frame>(const Frame&)>& answer) {
    EventSender sender(mapping_, scenario_.events, phase, dialogue_, counters_, {.flight = flight_}, end_us);
    for (std::int64_t due_us = sender.due_us(); due_us <= end_us; due_us = sender.due_us()) {
      while (!told_.empty() && told_.front().first <= due_us) {
        hear(sender, told_.front().second, told_.front().first);
        told_.erase(told_.begin());
        due_us = sender.due_us();
      }
      if (due_us > end_us) break;
      nodes::Transmission out;
      sender.transmit(out);
      for (const Frame& frame : out.frames()) {
        sent_.emplace_back(due_us, Bytes(frame.payload().begin(), frame.payload().end()));
        dialogue_.transmitted(frame, due_us * 1000, 0);
        for (const Frame& one : answer(frame)) hear(sender, one, due_us);
      }
    }
  }
  void tell_at(std::int64_t t_us, const Frame& frame) { told_.emplace_back(t_us, frame); }
  [[nodiscard]] const std::vector<std::pair<std::int64_t, Bytes>>& sent() const { return sent_; }
  [[nodiscard]] std::vector<checks::CheckResult> judged(const std::string& timing_unfit = "") const {
    checks::Observations seen(mapping_.messages);
    seen.exchanges = dialogue_.exchanges();
    seen.last_ns = 10'000'000'000;
    return checks::judge_events(scenario_.events,
                                {.seen = seen, .truth = {.flight = flight_}, .timing_unfit = timing_unfit});
  }
  [[nodiscard]] const scenario::Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const Mapping& mapping() const { return mapping_; }
  [[nodiscard]] const Dialogue& dialogue() const { return dialogue_; }

 private:
  std::optional<world::FlightRecord> drive_flight() {
    auto truth = drive::make_truth(scenario_);
    return std::move(*truth);
  }
  void hear(EventSender& sender, const Frame& frame, std::int64_t t_us) {
    dialogue_.received({.frame = frame, .t_ns = t_us * 1000 + 300'000});
    sender.hear(frame, t_us);
  }

  scenario::Scenario scenario_;
  const Mapping& mapping_;
  world::FlightRecord flight_;
  Dialogue dialogue_;
  Counters counters_;
  std::vector<std::pair<std::int64_t, Bytes>> sent_;
  std::vector<std::pair<std::int64_t, Frame>> told_;
};

Frame frame_of(std::uint32_t id, const Bytes& bytes) {
  Frame frame{.id = id, .size = 8};
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}
std::vector<Frame> tell(const Bytes& bytes) { return {frame_of(301, bytes)}; }
std::vector<Frame> nothing(const Frame& /*frame*/) { return {}; }

TEST(Events, AreSentAtTheirTimes) {
  EventTalk talk(R"([[event]]
at_s = 3
channel = "diagnosis"
request = "22 F1 90"
[[event]]
at_s = 1
channel = "mode"
request = "01"
times = 3
period_ms = 500
)");
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_THAT(talk.sent(),
              ElementsAre(Pair(1'000'000, ElementsAre(1, 0, 0, 0)), Pair(1'500'000, ElementsAre(1, 0, 0, 0)),
                          Pair(2'000'000, ElementsAre(1, 0, 0, 0)),
                          Pair(3'000'000, ElementsAre(3, 0x22, 0xF1, 0x90, 0xCC, 0xCC, 0xCC, 0xCC))));
}

TEST(Events, SendValuesOfSignals) {
  EventTalk talk("[[event]]\nat_s = 1\nchannel = \"mode\"\nvalues = { Power = 3, Level = 100.5 }\n");
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_THAT(talk.sent(), ElementsAre(Pair(1'000'000, ElementsAre(3, 201, 0, 0))));
}

// The heading is 40 sin(2 pi t / 10 s) deg: it passes 20 deg at 10 / 12 s.
TEST(Events, WaitForAConditionOfTheTruth) {
  EventTalk talk(
      "[[event]]\nwhen = \"attitude.heading > 20 * deg && attitude.heading < 180 * deg\"\ndelay_s = "
      "1\nchannel = \"mode\"\nrequest = \"01\"\n");
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  ASSERT_EQ(talk.sent().size(), 1U);
  EXPECT_NEAR(1e-6 * static_cast<double>(talk.sent()[0].first), 1 + 10.0 / 12, 0.02);
}

TEST(Events, WaitForAFlag) {
  EventTalk talk(R"([[event]]
flag_set = "warm"
channel = "diagnosis"
request = "11 01"
[[event]]
at_s = 4
channel = "mode"
request = "02"
)");
  talk.tell_at(2'000'000, frame_of(200, {0, 0, 0}));
  talk.tell_at(2'500'000, frame_of(200, {0, 0, 1}));
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_THAT(talk.sent(), ElementsAre(Pair(2'500'000, testing::_), Pair(4'000'000, testing::_)));
}

TEST(Events, FollowAnAnswer) {
  EventTalk talk(R"([[event]]
name = "first"
at = "start"
channel = "diagnosis"
request = "10 03"
expect = "50 03 *"
[[event]]
after = "first"
delay_s = 0.5
channel = "diagnosis"
request = "3E 00"
)");
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_THAT(talk.sent(), testing::IsEmpty()) << "both belong to the time before the run";
  talk.run(scenario::Phase::before, 10'000'000, [](const Frame& frame) {
    return frame.data[1] == 0x10 ? tell({6, 0x50, 3, 0, 50, 1, 0xF4}) : std::vector<Frame>{};
  });
  EXPECT_THAT(talk.sent(), ElementsAre(Pair(0, testing::_), Pair(500'000, testing::_)));
  ASSERT_EQ(talk.judged().size(), 1U);
  EXPECT_EQ(talk.judged()[0].outcome, Outcome::pass);
}

TEST(Events, OfAChannelWaitForEachOther) {
  EventTalk talk(R"([[event]]
at_s = 1
channel = "diagnosis"
request = "22 00 01"
expect = "62 00 01 *"
[[event]]
at_s = 1.2
channel = "diagnosis"
request = "22 00 02"
)");
  talk.tell_at(1'700'000, frame_of(301, {4, 0x62, 0, 1, 9}));
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_THAT(talk.sent(), ElementsAre(Pair(1'000'000, testing::_), Pair(1'700'000, testing::_)));
}

constexpr const char* read_serial = R"([[event]]
name = "serial"
requirement = "REQ-7"
at_s = 1
channel = "diagnosis"
request = "22 F1 8C"
expect = "62 F1 8C 41 .. *"
within_ms = 50
)";

TEST(Events, PutLongAnswersTogether) {
  EventTalk talk(read_serial);
  talk.run(scenario::Phase::during, 10'000'000, [](const Frame& frame) {
    if (frame.data[0] == 3) return tell({0x10, 9, 0x62, 0xF1, 0x8C, 0x41, 2, 3});
    return tell({0x21, 4, 5, 6});
  });
  EXPECT_EQ(talk.sent().back().second[0], 0x30) << "flow control";
  const auto judged = talk.judged();
  ASSERT_EQ(judged.size(), 1U);
  EXPECT_EQ(judged[0].outcome, Outcome::pass);
  EXPECT_EQ(judged[0].name, "serial");
  EXPECT_EQ(judged[0].requirement, "REQ-7");
  EXPECT_EQ(judged[0].measured, "62 F1 8C 41 02 03 04 05 06 after 0.3 ms");
  EXPECT_EQ(judged[0].expected, "62 F1 8C 41 .. * within 50 ms");
  EXPECT_EQ(talk.judged("virtual time")[0].outcome, Outcome::not_measured);
}

TEST(Events, WrongAnswersFail) {
  const auto outcome = [](const Bytes& answer) {
    EventTalk talk(read_serial);
    talk.run(scenario::Phase::during, 10'000'000, [&](const Frame&) { return tell(answer); });
    return talk.judged()[0];
  };
  EXPECT_EQ(outcome({3, 0x7F, 0x22, 0x31}).outcome, Outcome::fail);
  EXPECT_EQ(outcome({3, 0x7F, 0x22, 0x31}).measured, "7F 22 31 (request out of range)");
  EXPECT_EQ(outcome({5, 0x62, 0xF1, 0x8C, 0x42, 0}).outcome, Outcome::fail);
  EXPECT_EQ(outcome({4, 0x62, 0xF1, 0x8C, 0x41}).outcome, Outcome::fail) << "a byte is missing";
  EXPECT_EQ(outcome({5, 0x62, 0xF1, 0x8C, 0x41, 0}).outcome, Outcome::pass);
}

TEST(Events, SilenceFailsAndLateAnswersFail) {
  EventTalk silent(read_serial);
  silent.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_EQ(silent.judged()[0].outcome, Outcome::fail);
  EXPECT_THAT(silent.judged()[0].measured, HasSubstr("no answer within 1.05 s"));
  EventTalk late(read_serial);
  late.tell_at(1'080'000, frame_of(301, {5, 0x62, 0xF1, 0x8C, 0x41, 0}));
  late.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_EQ(late.judged()[0].outcome, Outcome::fail);
  EXPECT_THAT(late.judged()[0].measured, HasSubstr("after 80.3 ms"));
}

// The run is over then, so it cannot end before the answer.
TEST(Events, SilenceAfterTheRunFailsToo) {
  EventTalk talk(R"([[event]]
name = "session"
at = "end"
channel = "diagnosis"
request = "10 03"
expect = "50 03 *"
[[event]]
after = "session"
delay_s = 9.5
channel = "diagnosis"
request = "3E 00"
expect = "7E 00"
)");
  talk.run(scenario::Phase::after, 20'000'000, [](const Frame& frame) {
    return frame.data[1] == 0x10 ? tell({2, 0x50, 3}) : std::vector<Frame>{};
  });
  const auto judged = talk.judged();
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged[0].outcome, Outcome::pass);
  EXPECT_EQ(judged[1].outcome, Outcome::fail) << judged[1].measured;
}

// "Response pending" is no answer, and gives the target time.
TEST(Events, PendingResponseWaitsForTheAnswer) {
  EventTalk talk(R"([[event]]
at_s = 1
channel = "diagnosis"
request = "31 01 02 03"
expect = "71 01 02 03"
)");
  talk.tell_at(1'900'000, frame_of(301, {3, 0x7F, 0x31, 0x78}));
  talk.tell_at(2'700'000, frame_of(301, {4, 0x71, 1, 2, 3}));
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  EXPECT_EQ(talk.judged()[0].outcome, Outcome::pass) << talk.judged()[0].measured;
}

TEST(Events, WhatWasNotSentIsNotMeasured) {
  EventTalk talk(R"([[event]]
flag_set = "warm"
channel = "mode"
request = "01"
[[event]]
when = "attitude.roll > 1"
channel = "mode"
request = "02"
)");
  talk.run(scenario::Phase::during, 10'000'000, nothing);
  const auto judged = talk.judged();
  ASSERT_EQ(judged.size(), 2U);
  for (const auto& one : judged) EXPECT_EQ(one.outcome, Outcome::not_measured);
}

// Without the sender, as in a log: equal requests belong to the events in the order of the scenario.
TEST(Events, OfALogAreFoundByTheirBytes) {
  EventTalk talk(R"([[event]]
name = "before"
at_s = 1
channel = "diagnosis"
request = "19 02 08"
expect = "59 02 09"
[[event]]
name = "after"
at_s = 5
channel = "diagnosis"
request = "19 02 08"
expect = "59 02 09 12 34 56 08"
)");
  Dialogue log(talk.mapping(), talk.scenario().events);
  const auto exchange = [&](const Bytes& answer) {
    log.transmitted(frame_of(300, {3, 0x19, 2, 8}), 0, 0);
    log.received({.frame = frame_of(301, answer), .t_ns = 5});
  };
  exchange({3, 0x59, 2, 9});
  exchange({7, 0x59, 2, 9, 0x12, 0x34, 0x56, 8});
  ASSERT_EQ(log.exchanges().size(), 2U);
  EXPECT_EQ(log.exchanges()[0].event, 0U);
  EXPECT_EQ(log.exchanges()[1].event, 1U);
  EXPECT_THAT(log.exchanges()[1].answer, Optional(testing::SizeIs(7)));
}

TEST(Events, AreReadStrictly) {
  EXPECT_EQ(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01 02\"\n"), "");
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"0\"\n"), HasSubstr("'0' is no byte"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01 ..\"\n"), HasSubstr("leaves bytes open"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01 02 03 04 05\"\n"), HasSubstr("at most 4"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01\"\nexpect = \"02\"\n"),
              HasSubstr("no response"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\n"), HasSubstr("request"));
  EXPECT_THAT(wrong("channel = \"mode\"\nrequest = \"01\"\n"), HasSubstr("at_s"));
  EXPECT_THAT(wrong("at_s = 1\nat = \"start\"\nchannel = \"mode\"\nrequest = \"01\"\n"),
              HasSubstr("no effect beside"));
  EXPECT_THAT(wrong("at_s = 11\nchannel = \"mode\"\nrequest = \"01\"\n"), HasSubstr("at_s"));
  EXPECT_THAT(wrong("at_s = 1\nchanel = \"diagnosis\"\nrequest = \"01\"\nexpect = \"41\"\n"),
              HasSubstr("'channel'"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"bus\"\nrequest = \"01\"\n"), HasSubstr("'bus'"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nvalues = { Power = 300 }\n"),
              HasSubstr("does not fit into Power"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nvalues = { Heat = 1 }\n"), HasSubstr("Heat"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"diagnosis\"\nvalues = { AskBytes = 1 }\n"),
              HasSubstr("transport protocol"));
  EXPECT_THAT(wrong("flag_set = \"cold\"\nchannel = \"mode\"\nrequest = \"01\"\n"), HasSubstr("'cold'"));
  EXPECT_THAT(wrong("after = \"x\"\nchannel = \"mode\"\nrequest = \"01\"\n"), HasSubstr("'x'"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01\"\ntimes = 2\n"), HasSubstr("period_ms"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"diagnosis\"\nrequest = \"01\"\nwithin_ms = 5\n"),
              HasSubstr("expect"));
  EXPECT_THAT(wrong("at_s = 1\nchannel = \"mode\"\nrequest = \"01\"\ncolour = 1\n"), HasSubstr("colour"));
  EXPECT_THAT(wrong("when = \"heading\"\nchannel = \"mode\"\nrequest = \"01\"\n"), HasSubstr("heading"));
}

TEST(EventChannels, AreReadStrictly) {
  const auto channel_error = [](const std::string& text) {
    const auto read = with("", event_mapping + text);
    return read ? "" : read.error().message;
  };
  EXPECT_THAT(channel_error("[channels.more]\nrequest = \"Ask\"\ntransport = \"frame\"\n"),
              HasSubstr("already used"));
  EXPECT_THAT(channel_error("[channels.more]\nrequest = \"Nope\"\ntransport = \"frame\"\n"),
              HasSubstr("no message 'Nope'"));
  EXPECT_THAT(channel_error("[channels.more]\nrequest = \"In\"\ntransport = \"can_tp\"\n"),
              HasSubstr("can_tp"));
}

}  // namespace
}  // namespace canhil::mapping
