// Checks that judge only while a condition holds, on a flight with the device in this process.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::drive {
namespace {

using checks::Outcome;
using testing::HasSubstr;

// The scenario los_quick with these tables in place of its checks.
std::string text_with(const std::string& tables) {
  std::ifstream file(SOURCE_DIR "/bench/flights/los_quick.toml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  return text.substr(0, text.find("[[check]]")) + tables;
}

// The checks of a flight whose seeker sees nothing from 3 to 3.2 s.
std::vector<checks::CheckResult> judged(const std::string& tables) {
  const std::vector<scenario::Setting> blackout{
      {.key = "seeker.blackout_s", .value = "[3.0, 3.2]", .elements = {}, .line = 1}};
  const auto scenario = scenario::parse(text_with(tables), "c.toml", contract(), blackout);
  EXPECT_TRUE(scenario) << (scenario ? "" : scenario.error().message);
  const auto truth = make_truth(*scenario);
  auto flown = run_in_process(*scenario, *truth, 0);
  return checks::judge(*scenario, {.seen = flown->seen,
                                   .truth = truth_of(*truth, flown->per_run_truth, scenario->duration_us),
                                   .estimators = estimators::all(),
                                   .ended_early = flown->ending.detail,
                                   .timing_unfit = "virtual time"})
      .checks;
}

std::string error_check(const std::string& name, const std::string& keys) {
  return "[[check]]\nname = '" + name +
         "'\nkind = 'error'\nquantity = 'los.rate.pitch'\nstatistic = 'rms'\nbelow_mradps = 100\n" + keys +
         "\n";
}
std::string flag_check(const std::string& name, const std::string& keys) {
  return "[[check]]\nname = '" + name + "'\nkind = 'flag'\n" + keys + "\n";
}

TEST(Condition, SelectsTheSamePartOfARunAsTimesDo) {
  const auto all = judged(
      error_check("times", "from_s = 1\nto_s = 2") + error_check("while t", "while = 't >= 1 && t <= 2'") +
      error_check("to go", "time_to_go_s = [1, 2]") +
      error_check("while to go", "while = 'plant.time_to_go >= 1 && plant.time_to_go < 2'") +
      error_check("whole", ""));
  EXPECT_EQ(all[0].measured, all[1].measured);
  EXPECT_EQ(all[2].measured, all[3].measured);
  EXPECT_NE(all[0].measured, all[2].measured);
  EXPECT_NE(all[0].measured, all[4].measured);
  EXPECT_EQ(all[3].outcome, Outcome::pass);
  EXPECT_THAT(all[1].expected, HasSubstr("while t >= 1 && t <= 2"));
}

TEST(Condition, KnowsWhatTheTargetReports) {
  const auto all = judged(
      flag_check("coasts", "flag = 'coasting'\nwhile = 't > 3.005 && t < 3.2'") +
      flag_check("never coasts", "flag = 'coasting'\nstate = 'clear'\nwhile = 't > 3.005 && t < 3.2'") +
      flag_check("only then",
                 "flag = 'coasting'\nstate = 'clear'\nwhile = '!(t > 2.995 && t < 3.205) && t < 5.5'") +
      // Each value that the filter tells is that of its own answer, so this holds at each coasting answer.
      flag_check("itself", "flag = 'coasting'\nwhile = 'flag.coasting'") +
      error_check("small errors", "while = 'abs(error.los.rate.pitch) < 0.001'") +
      error_check("small estimates", "while = 'abs(estimate.los.rate.pitch - los.rate.pitch) < 0.001'") +
      error_check("sigmas", "while = 'sigma.los.rate.pitch > 0'") + error_check("whole", ""));
  EXPECT_EQ(all[0].outcome, Outcome::pass) << all[0].measured;
  EXPECT_EQ(all[1].outcome, Outcome::fail) << all[1].measured;
  EXPECT_EQ(all[2].outcome, Outcome::pass) << all[2].measured;
  EXPECT_EQ(all[3].outcome, Outcome::pass) << all[3].measured;
  EXPECT_EQ(all[3].measured, "set in 42 of 42 answers");
  EXPECT_EQ(all[4].measured, all[5].measured) << "the error is the estimate less the truth";
  EXPECT_NE(all[4].measured, all[7].measured);
  EXPECT_EQ(all[6].measured, all[7].measured) << "each answer has a sigma";
}

TEST(Condition, KnowsFaults) {
  const std::string fault =
      "[[fault]]\nname = 'radar off'\nkind = 'bias'\nquantity = 'seeker.error_pitch'\nby_deg = 1\n"
      "from_s = 1\nto_s = 1.5\n";
  const auto all = judged(fault + error_check("during", "while = 'fault.radar_off'") +
                          error_check("else", "while = '!fault.radar_off'") +
                          error_check("times", "from_s = 1\nto_s = 1.5"));
  EXPECT_EQ(all[0].measured, all[2].measured);
  EXPECT_THAT(all[0].measured, HasSubstr(" of 101"));
  EXPECT_THAT(all[1].measured, HasSubstr(" of 1010"));
}

TEST(Condition, ThatNeverHoldsIsNotMeasured) {
  const auto all = judged(error_check("never", "while = 'plant.range > 1e9'") +
                          flag_check("never set", "flag = 'coasting'\nwhile = 'plant.range > 1e9'"));
  for (const checks::CheckResult& one : {all[0], all[1]}) {
    EXPECT_EQ(one.outcome, Outcome::not_measured);
    EXPECT_EQ(one.measured, "the condition held at no answer");
  }
}

TEST(Condition, SaysWhatIsWrong) {
  const auto wrong = [](const std::string& condition) {
    const auto scenario =
        scenario::parse(text_with(error_check("x", "while = '" + condition + "'")), "c.toml", contract());
    return scenario ? "" : scenario.error().message;
  };
  EXPECT_THAT(wrong("flag.coastng"), HasSubstr("'flag.coastng' is no true value, expected 'flag.coasting'"));
  EXPECT_THAT(wrong("1 +"), HasSubstr("is no expression"));
  EXPECT_THAT(wrong("fault.gone"), HasSubstr("'fault.gone' is no true value"));
  EXPECT_EQ(wrong("flag.coasting == 0"), "");
}

}  // namespace
}  // namespace canhil::drive
