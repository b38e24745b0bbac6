// Which stimuli reached the bus, so that the target must or may answer them, and which answers the listener
// counts.
#include <gmock/gmock.h>

#include "bench/mapping/listener.hpp"
#include "dbc/parser/codec.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

constexpr const char* dbc_text = R"(VERSION ""
BU_: Bench Device
BO_ 100 In: 8 Bench
 SG_ Angle : 0|16@1- (0.01,0) [0|0] "deg" Device
 SG_ Count : 16|8@1+ (1,0) [0|0] "" Device
 SG_ Crc : 56|8@1+ (1,0) [0|0] "" Device
BO_ 101 Out: 8 Device
 SG_ Page M : 0|8@1+ (1,0) [0|3] "" Bench
 SG_ Repeated : 8|8@1+ (1,0) [0|0] "" Bench
 SG_ Roll m0 : 16|16@1- (0.01,0) [0|0] "deg" Bench
 SG_ Pitch m1 : 16|16@1- (0.01,0) [0|0] "deg" Bench
)";
const std::string mapping_text = R"(dbc = "ecu.dbc"
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Angle" = "master_ins.roll"
[[hear]]
message = "Out"
answers = "In"
echo = { signal = "Repeated", of = "In.Count" }
signals = { Roll = "attitude.roll", Pitch = "attitude.pitch" }
[[protection]]
messages = ["In"]
counter = { signal = "Count" }
)";
constexpr const char* scenario_text = R"(
title = "a turn"
duration_s = 1.0
seed = 1
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 45.0
longitude_deg = 9.0
height_m = 0.0
trajectory = "spiral"
speed_mps = 5.0
heading_deg = 0.0
turn_period_s = 10.0
[master_ins]
period_ms = 20
[[check]]
kind = "answers"
answers_at_least = 1
)";

class Exchange : public testing::Test {
 protected:
  void begin(const std::string& more = "") {
    auto read = read_mapped(scenario_text, mapping_text + more, dbc_text);
    ASSERT_TRUE(read) << read.error().message;
    scenario_ = std::move(*read);
    const auto& mapping = dynamic_cast<const Mapping&>(*scenario_.binding);
    conversation_.emplace(mapping);
    passing_.emplace(*conversation_);
    listener_.emplace(*conversation_, std::vector<checks::TimedWindow>{}, WireFacts{}, true);
  }
  [[nodiscard]] const Hear& answer() const { return conversation_->mapping.hears.front(); }
  static std::int64_t at_us(int k) { return 20'000 * static_cast<std::int64_t>(k); }
  /// The k-th stimulus, which the player makes at its time.
  Frame made(int k) {
    const Mapped& in = conversation_->mapping.plays.front().messages.front().of;
    std::vector<std::uint8_t> bytes(8);
    bytes[2] = static_cast<std::uint8_t>(k);
    const Frame frame = in.frame(bytes);
    conversation_->add(0, {.valid_us = at_us(k),
                           .due_us = at_us(k),
                           .messages = {bytes},
                           .frames = {frame},
                           .message_of = {0}});
    return frame;
  }
  void answered(int k, int page) {
    Frame frame{.id = 101, .size = 8};
    frame.data[0] = static_cast<std::uint8_t>(page);
    frame.data[1] = static_cast<std::uint8_t>(k);
    listener_->received({.frame = frame, .t_ns = t_ns_ += 1'000'000});
  }
  void sent(const Frame& frame) { listener_->transmitted(frame, t_ns_ += 1'000'000, 0); }
  /// Of the answers: those to no stimulus, and those given twice.
  std::pair<std::uint64_t, std::uint64_t> wrong() {
    const std::size_t index = answer().of.index;
    const checks::Observations seen = listener_->finish();
    return {seen.timing.answers[index].unpaired, seen.timing.answers[index].repeated};
  }
  [[nodiscard]] bool must(const Frame& frame) { return passing_->take(frame).has_value(); }
  [[nodiscard]] bool may(int k) const { return passing_->may_answer(0, at_us(k), 0); }

  scenario::Scenario scenario_;
  std::optional<Conversation> conversation_;
  std::optional<Passing> passing_;
  std::optional<Listener> listener_;
  std::int64_t t_ns_ = 0;
};

TEST_F(Exchange, DelayedFramesThatNobodyOvertakesMustBeAnswered) {
  begin();
  const Frame one = made(1), two = made(2), three = made(3);
  for (const Frame& frame : {one, two, three}) EXPECT_TRUE(must(frame));
  EXPECT_FALSE(must(one)) << "sent twice";
}

TEST_F(Exchange, AFrameThatWasOvertakenMayBeAnswered) {
  begin();
  const Frame one = made(1), two = made(2);
  EXPECT_TRUE(must(two));
  EXPECT_FALSE(may(1)) << "it has not come";
  EXPECT_FALSE(must(one));
  EXPECT_TRUE(may(1));
  EXPECT_FALSE(may(2)) << "it must be";
}

TEST_F(Exchange, AFrameThatWasChangedMayBeAnsweredUnlessAChecksumShowsIt) {
  for (const bool checksum : {false, true}) {
    begin(checksum ? "checksum = { signal = \"Crc\", model = \"CRC-8/SAE-J1850\" }\n" : "");
    Frame changed = made(1);
    changed.data[0] ^= 1;
    EXPECT_FALSE(must(changed));
    EXPECT_EQ(may(1), !checksum);
    made(2);
    changed.data[2] = 77;  // the counter, which the answer repeats
    EXPECT_FALSE(must(changed));
    EXPECT_EQ(passing_->carried_changed(answer(), 77), !checksum);
    EXPECT_FALSE(passing_->carried_changed(answer(), 78));
    Frame shorter = made(3);
    shorter.size = 7;
    EXPECT_FALSE(must(shorter));
    EXPECT_FALSE(may(3)) << "its size shows it";
  }
}

TEST_F(Exchange, AnswersToWhatTheBenchSpoiltAreNotCountedAsWrong) {
  begin();
  const Frame one = made(1), two = made(2);
  for (const Frame& frame : {two, one}) sent(frame);  // reordered
  answered(2, 0);
  answered(1, 0);
  Frame changed = made(3);
  changed.data[2] = 77;
  sent(changed);
  answered(77, 0);
  EXPECT_EQ(wrong(), std::pair(std::uint64_t{0}, std::uint64_t{0}));
}

TEST_F(Exchange, AnAnswerToNothingIsWrong) {
  begin();
  sent(made(1));
  answered(1, 0);
  answered(2, 0);
  EXPECT_EQ(wrong(), std::pair(std::uint64_t{1}, std::uint64_t{0}));
}

TEST_F(Exchange, PagesOfAnAnswerAreNotAnswersGivenTwice) {
  begin();
  for (int k = 1; k <= 5; ++k) {
    sent(made(k));
    for (const int page : {0, 1}) answered(k, page);
  }
  EXPECT_EQ(wrong(), std::pair(std::uint64_t{0}, std::uint64_t{0}));
}

TEST_F(Exchange, APageGivenTwiceIsWrong) {
  begin();
  for (int k = 1; k <= 5; ++k) {
    sent(made(k));
    for (const int page : {0, 1, 1}) answered(k, page);
  }
  EXPECT_EQ(wrong(), std::pair(std::uint64_t{0}, std::uint64_t{5}));
}

}  // namespace
}  // namespace canhil::mapping
