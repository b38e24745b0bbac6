// The handshake with targets that are slow, receive nothing, disobey, or have another DBC.
#include "bench/drive/handshake.hpp"

#include <gmock/gmock.h>

#include "bench/drive/contract.hpp"
#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::drive {
namespace {

using namespace messages;
using testing::HasSubstr;

TEST(Contract, KnowsWhichEstimatorSendsEachAnswer) {
  for (const std::string& message : contract().answers)
    EXPECT_TRUE(contract().sent_by.contains(message)) << message;
  EXPECT_EQ(contract().sent_by.at("AlignAttitude"), "transfer_alignment");
  EXPECT_EQ(contract().sent_by.at("FixUpdate"), "inflight_alignment");
  EXPECT_EQ(contract().sent_by.at("LosRateTarget"), "los_rate");
  EXPECT_EQ(contract().sent_by.at("WindVector"), "wind");
}

// A target that obeys all commands; the tests make this target misbehave.
class Handshake : public testing::Test {
 protected:
  Handshake() {
    port_.on_send = [this](const Frame& frame) { answer(frame); };
    beat();
  }

  virtual void answer(const Frame& frame) {
    if (frame.id == TargetCommand::info.id) {
      const auto command = from_frame<TargetCommand>(frame);
      if (deaf_to_commands_-- > 0) return;
      if (command.command == Command::reset) {
        heartbeat_.state = TargetState::idle;
        heartbeat_.estimator = offers_ ? command.estimator : Estimator::none;
        heartbeat_.algorithm = command.algorithm;
        heartbeat_.error_command = offers_ ? 0 : 1;
      } else if (command.command == Command::start && starts_) {
        heartbeat_.state = TargetState::running;
      }
      beat();
    } else if (frame.id == ParamSet::info.id) {
      const auto request = from_frame<ParamSet>(frame);
      port_.give(ParamAck{
          .parameter = request.parameter, .value = request.value + misread_, .status = parameter_status_});
    } else if (frame.id == TargetInitVelocityD::info.id) {
      heartbeat_.state = TargetState::ready;
      beat();
    }
  }
  void beat() {
    heartbeat_.dbc_hash = exchange_hash24(name_of(heartbeat_.estimator)) ^ other_;
    port_.give(heartbeat_);
  }

  Result<void> configure() {
    nodes::Transmission out;
    Link link(port_);
    const InitialState nowhere;
    return drive::configure(link, out, std::span(&setup_, 1), std::span(&nowhere, 1),
                            [this] { return gone_; });
  }
  [[nodiscard]] auto sent(std::uint32_t id) const { return std::ranges::count(port_.sent, id, &Frame::id); }

  FakePort port_;
  TargetHeartbeat heartbeat_;
  std::uint32_t other_ = 0;  // the difference of the target's hash
  scenario::TargetSetup setup_{
      .estimator = "transfer_alignment",
      .algorithm = "robust_h2",
      .initial_sigma = {},
      .parameters = {{.name = "h2_case", .value = 2, .where = "my.toml:9: key 'h2_case'"}}};
  std::optional<std::string> gone_;
  bool offers_ = true;
  bool starts_ = true;
  int deaf_to_commands_ = 0;
  float misread_ = 0;
  ParameterStatus parameter_status_ = ParameterStatus::accepted;
};

TEST_F(Handshake, ATargetThatAnswersInTheOtherFormatIsNamed) {
  Received foreign = port_.receive().value();
  foreign.frame.fd = foreign.frame.brs = foreign.foreign = true;
  port_.give(foreign);
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message,
            "target on 'fake': answers in CAN FD frames (canhil-fd), expected classic frames (canhil)");
}

TEST_F(Handshake, ConfiguresAndStartsWithEachStepOnce) {
  const auto done = configure();
  ASSERT_TRUE(done) << done.error().message;
  std::vector<std::uint32_t> ids;
  for (const Frame& frame : port_.sent) ids.push_back(frame.id);
  EXPECT_THAT(ids,
              testing::ElementsAre(TargetCommand::info.id, ParamSet::info.id, TargetInitLatitude::info.id,
                                   TargetInitLongitude::info.id, TargetInitVelocityNE::info.id,
                                   TargetInitAttitude::info.id, TargetInitSigma::info.id,
                                   TargetInitVelocityD::info.id, TargetCommand::info.id));
}

TEST_F(Handshake, TwoTargetsThatAcknowledgeEachStepAreNotTaken) {
  const scenario::Parameter parameter = setup_.parameters.front();
  setup_.parameters.assign(5, parameter);
  port_.on_send = [this](const Frame& frame) {
    answer(frame);
    std::vector<Received> answers;
    while (const auto one = port_.receive()) answers.push_back(*one);
    for (const Received& one : answers) {
      port_.give(one);
      port_.give(one);  // from a second target with the same counters
    }
  };
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message,
            "target on 'fake': a second target answers on this bus, expected to be the only one");
}

TEST_F(Handshake, RepeatsACommandThatWasNotHeard) {
  deaf_to_commands_ = 2;
  EXPECT_TRUE(configure());
  EXPECT_EQ(sent(TargetCommand::info.id), 4);
  EXPECT_EQ(sent(ParamSet::info.id), 1);
}

TEST_F(Handshake, AHeartbeatOfTheLastRunIsNotTheAnswerToAReset) {
  deaf_to_commands_ = 1;
  port_.on_send = [this](const Frame& frame) {
    if (deaf_to_commands_ > 0) {
      heartbeat_.estimator = Estimator::transfer_alignment;  // left from an earlier run
      heartbeat_.algorithm = Algorithm::kalman;
      beat();
    }
    answer(frame);
  };
  EXPECT_TRUE(configure());
  EXPECT_EQ(sent(TargetCommand::info.id), 3);
}

TEST_F(Handshake, RefusesATargetOfAnotherDbcWithoutCommandingIt) {
  other_ = 1;
  beat();
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("different DBC files"));
  EXPECT_TRUE(port_.sent.empty());
}

TEST_F(Handshake, RefusesATargetWhoseMessagesForTheEstimatorDiffer) {
  port_.on_send = [this](const Frame& frame) {
    if (frame.id == TargetCommand::info.id) heartbeat_.error_dbc_mismatch = 1;  // and stays as it is
    beat();
  };
  const auto refused = configure();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("of the messages for 'transfer_alignment'"));
  port_.on_send = [this](const Frame& frame) {
    other_ = 1;  // a target that does not compare
    answer(frame);
  };
  heartbeat_.error_dbc_mismatch = 0;
  beat();
  const auto differs = configure();
  ASSERT_FALSE(differs);
  EXPECT_THAT(differs.error().message, HasSubstr("from different DBC files for 'transfer_alignment'"));
}

TEST_F(Handshake, TheEstimatorOfAnEarlierRunMayHaveOtherMessages) {
  for (const Estimator earlier : {Estimator::wind, Estimator{7}}) {
    heartbeat_.estimator = earlier;
    other_ = 1;
    beat();
    other_ = 0;
    EXPECT_TRUE(configure());
  }
}

TEST_F(Handshake, NamesAnEstimatorThatTheTargetDoesNotOffer) {
  offers_ = false;
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_THAT(
      done.error().message,
      HasSubstr("does not offer 'robust_h2' for 'transfer_alignment', expected one of: kalman, robust_h2"));
  EXPECT_THAT(done.error().message, HasSubstr("its errors: command"));
}

TEST_F(Handshake, SaysWhereAParameterStandsThatTheTargetRefusesAndWhy) {
  const auto refused_with = [&](ParameterStatus status) {
    parameter_status_ = status;
    beat();
    const auto done = configure();
    EXPECT_FALSE(done);
    return done ? "" : done.error().message;
  };
  const std::string sent = "my.toml:9: key 'h2_case': 2 was sent and refused by the target: ";
  EXPECT_EQ(refused_with(ParameterStatus::out_of_range),
            sent + "out_of_range, expected a whole number from 1 to 4; 2 stays in force");
  EXPECT_EQ(refused_with(ParameterStatus::unknown),
            sent + "unknown, expected a parameter of transfer_alignment");
  EXPECT_EQ(refused_with(ParameterStatus::wrong_state),
            sent + "wrong_state, expected to be set before the start; 2 stays in force");
  EXPECT_EQ(refused_with(static_cast<ParameterStatus>(9)), sent + "status 9, which is not in the DBC");
}

TEST_F(Handshake, NamesAParameterThatReadsBackOtherwise) {
  misread_ = 0.5F;
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "my.toml:9: key 'h2_case': 2 was sent, the target reads back 2.5");
}

TEST_F(Handshake, SaysInWhichStateATargetIsThatDoesNotStart) {
  starts_ = false;
  heartbeat_.error_not_initialised = 1;
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message,
              HasSubstr("answers, but never says running within 2 s while starting: state ready, estimator "
                        "transfer_alignment, algorithm robust_h2, errors: not_initialised"));
}

TEST_F(Handshake, DoesNotWaitForATargetThatIsGone) {
  deaf_to_commands_ = 1000;
  gone_ = "target: exited with 1";
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "target: exited with 1 while being reset");
}

TEST_F(Handshake, NamesABusThatIsGone) {
  port_.gone = true;
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("bus 'fake': gone while waiting for its heartbeat"));
}

TEST_F(Handshake, NamesABusThatIsDown) {
  port_.outcome = SendOutcome::down;
  const auto done = configure();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("bus 'fake': takes no frames"));
}

TEST_F(Handshake, AHeartbeatWithAWrongCrcIsNone) {
  FakePort port;
  port.target.send(TargetHeartbeat{.dbc_hash = exchange_hash24() ^ 1U});
  Frame frame = port.target.frames().front();
  frame.data[0] ^= 1U;
  port_.give(frame);
  EXPECT_TRUE(configure());
}

}  // namespace
}  // namespace canhil::drive
