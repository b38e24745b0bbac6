// Tests output_complaints(): other tests decide with this function whether the outputs of a run passed, so it
// must not accept outputs that failed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A run in virtual time, in which timing is not measured. Each test changes the report of this run, as if the
// run had ended differently.
class OutputComplaints : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string file = scratch("outputs.json");
    flown_ = hil_bench(
        fmt::format("run {} --bus in-process --json {}", scenario("transfer_alignment_quick"), file));
    of_flown_ = read_json(file);
  }

  // Sets the outcome of the first check of this kind, and the verdict of the run, to `outcome`.
  void end_with(const std::string& kind, const std::string& outcome) {
    for (auto& check : report_["checks"]) {
      if (check["kind"] != kind) continue;
      check["outcome"] = outcome;
      report_["verdict"] = outcome;
      ended_.code = outcome == "pass" ? 0 : outcome == "fail" ? 1 : 3;
      return;
    }
    FAIL() << "no check of kind " << kind;
  }
  void bench_was_late_by(double s) { report_["bench_lateness_s"]["max"] = s; }
  [[nodiscard]] std::vector<std::string> complaints() const { return output_complaints(ended_, report_); }

  static inline Ended flown_;
  static inline nlohmann::json of_flown_;
  Ended ended_ = flown_;
  nlohmann::json report_ = of_flown_;
};

TEST_F(OutputComplaints, NoneOfAGoodRunThoughItsTimingIsNotMeasured) {
  EXPECT_EQ(report_["verdict"], "not measured");
  EXPECT_THAT(complaints(), IsEmpty());
}

TEST_F(OutputComplaints, NameAnOutputThatFailedHoweverLateTheHostWas) {
  for (const char* kind : {"error", "consistency", "counters"}) {
    report_ = of_flown_;
    bench_was_late_by(1);
    end_with(kind, "fail");
    EXPECT_THAT(complaints(), ElementsAre(HasSubstr(fmt::format("\"kind\":\"{}\"", kind)),
                                          "the verdict is 'fail', and no check of timing is why"));
    end_with("latency",
             "fail");  // a reason for the verdict 'fail', but no excuse for the failed output check
    EXPECT_THAT(complaints(), ElementsAre(HasSubstr(fmt::format("\"kind\":\"{}\"", kind))));
  }
}

TEST_F(OutputComplaints, NameAnOutputThatWasNotMeasured) {
  end_with("error", "not measured");
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("error attitude.heading")));
}

// A failed timing check is excused only if the bench was late by more than half of the check's limit. The
// limit of latency is 5 ms, that of output_period is 5 ms (50 % of 10 ms), and that of heartbeat is 0.5 s.
TEST_F(OutputComplaints, ExcuseATimingThatFailedByALateHostAlone) {
  for (const auto& [kind, half_bar_s] :
       {std::pair{"latency", 2.5e-3}, {"output_period", 2.5e-3}, {"heartbeat", 0.25}}) {
    report_ = of_flown_;
    end_with(kind, "fail");
    EXPECT_THAT(complaints(),
                ElementsAre(HasSubstr("the host was not late"), HasSubstr("the verdict is 'fail'")))
        << kind << " in lockstep";
    bench_was_late_by(0.99 * half_bar_s);
    EXPECT_THAT(complaints(),
                ElementsAre(HasSubstr("the host was not late"), HasSubstr("the verdict is 'fail'")))
        << kind;
    bench_was_late_by(1.01 * half_bar_s);
    EXPECT_THAT(complaints(), IsEmpty()) << kind;
  }
}

// The check of an answer's time: not measured on a busy host, but never excused if it failed.
TEST_F(OutputComplaints, NameAnEventThatFailedAndNotOneThatWasNotTimed) {
  nlohmann::json event = report_["checks"][0];
  event.update({{"kind", "event"}, {"unit", "ms"}, {"upper", 50.0}, {"outcome", "pass"}});
  report_["checks"].push_back(event);
  EXPECT_THAT(complaints(), IsEmpty());
  end_with("event", "not measured");
  EXPECT_THAT(complaints(), IsEmpty());
  bench_was_late_by(1);
  end_with("event", "fail");
  EXPECT_THAT(complaints(),
              ElementsAre(HasSubstr("\"event\""), "the verdict is 'fail', and no check of timing is why"));
  // An answer without a limit of time, which the report of a run gives no unit, must be measured.
  for (const char* key : {"unit", "upper"}) report_["checks"].back().erase(key);
  end_with("event", "not measured");
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("\"event\"")));
}

TEST_F(OutputComplaints, NameAnExitCodeAnEndAndTooFewChecks) {
  ended_.code = 0;
  EXPECT_THAT(complaints(), ElementsAre("the verdict is 'not measured', the exit code 0"));
  ended_ = flown_;
  report_["ending"]["completed"] = false;
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("\"completed\":false")));
  report_ = of_flown_;
  report_["checks"].erase(0);
  EXPECT_THAT(complaints(), IsEmpty());
  report_["checks"].erase(0);
  EXPECT_THAT(complaints(), ElementsAre("4 checks of outputs, expected at least 5"));
}

// There must be complaints about a run that fails. This run fails because of a limit that no estimator can
// meet.
TEST_F(OutputComplaints, OfARunThatFailed) {
  const std::string strict = scratch("strict.toml"), file = scratch("strict.json");
  std::string text = read(scenario("transfer_alignment_quick"));
  const std::string bar = "below_mrad = 31.0";
  ASSERT_NE(text.find(bar), std::string::npos);
  std::ofstream(strict) << text.replace(text.find(bar), bar.size(), "below_mrad = 1e-6");
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --json {}", strict, bus(), file));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(output_complaints(ended, read_json(file)), Contains(HasSubstr("error attitude.heading")));
}

}  // namespace
}  // namespace canhil::test
