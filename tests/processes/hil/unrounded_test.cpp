// Flies a scenario twice, with rounded and with unrounded frames, and compares the errors. The difference is
// the effect of the rounding on the bus.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

nlohmann::json report_of(const std::string& bus) {
  const std::string path = scratch("unrounded.json");
  const Ended ended = shell(fmt::format("{} run {} --bus '{}' --json {}", HIL_BENCH,
                                        scenario("transfer_alignment_quick"), bus, path));
  EXPECT_EQ(ended.code, 3) << "virtual time measures no timing\n" << ended.out << ended.err;
  return read_json(path);
}

TEST(Unrounded, TheRunPassesAndItsErrorsDifferByALittle) {
  const auto rounded = report_of("in-process");
  const auto exact = report_of("in-process?unrounded");
  int judged = 0;
  for (const auto& check : exact["checks"]) {
    EXPECT_NE(check["outcome"], "fail") << check;
    judged += check["outcome"] == "pass" ? 1 : 0;
  }
  EXPECT_GE(judged, 5);
  for (const char* axis : {"roll", "pitch", "heading"}) {
    const double difference = figure(exact, "transfer_alignment", "final_error", axis) -
                              figure(rounded, "transfer_alignment", "final_error", axis);
    EXPECT_NE(difference, 0.0) << axis;
    // Attitude is sent in steps of 0.003 deg = 52 urad. The difference is up to half a step of the output,
    // plus the effect of rounded measurements on the estimate. The errors themselves are up to 2.4 mrad here.
    EXPECT_LT(std::abs(difference), 1e-4) << axis;
  }
  EXPECT_EQ(exact["provenance"]["bus"], "in-process?unrounded") << "a report says how its frames travelled";
}

// Unrounded frames exist only on the bus within the process of hil-bench. Logs and other buses are refused,
// because they cannot contain such frames.
TEST(Unrounded, NoLogAndNoOtherBusCarriesThem) {
  const std::string run = fmt::format("{} run {} --bus ", HIL_BENCH, scenario("transfer_alignment_quick"));
  const Ended logged = shell(run + "'in-process?unrounded' --log " + scratch("unrounded.log"));
  EXPECT_EQ(logged.code, 2);
  EXPECT_EQ(logged.err,
            "hil-bench: --log: a log has no room for the frames of 'in-process?unrounded', expected "
            "in-process\n");
  for (const char* bus : {"'local:?unrounded'", "'in-process?unrounded&bitrate=500000'"}) {
    const Ended refused = shell(run + bus);
    EXPECT_EQ(refused.code, 2) << bus;
    EXPECT_THAT(refused.err, HasSubstr("'unrounded' is not understood")) << bus;
  }
}

}  // namespace
}  // namespace canhil::test
