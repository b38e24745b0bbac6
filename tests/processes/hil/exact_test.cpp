// hil-bench-exact: the same run on frames that round nothing. The difference is the cost of the bus.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

nlohmann::json report_of(const std::string& program) {
  const std::string path = scratch("twin.json");
  const Ended ended = shell(fmt::format("{} run {} --bus in-process --json {}", program,
                                        scenario("transfer_alignment_quick"), path));
  EXPECT_EQ(ended.code, 3) << "virtual time measures no timing\n" << ended.out << ended.err;
  return read_json(path);
}

TEST(Exact, TheRunPassesAndItsErrorsDifferByALittle) {
  const auto rounded = report_of(HIL_BENCH);
  const auto exact = report_of(HIL_BENCH_EXACT);
  int judged = 0;
  for (const auto& check : exact["checks"]) {
    EXPECT_NE(check["outcome"], "fail") << check;
    judged += check["outcome"] == "pass" ? 1 : 0;
  }
  EXPECT_GE(judged, 5);
  for (const char* axis : {"roll_rad", "pitch_rad", "heading_rad"}) {
    const double difference = exact["alignments"][0]["final_error"][axis].get<double>() -
                              rounded["alignments"][0]["final_error"][axis].get<double>();
    EXPECT_NE(difference, 0.0) << axis;
    // Attitude travels in steps of 0.003 deg = 52 urad: half a step on the way out, and what rounding of the
    // measurements does to the estimate. The errors themselves are up to 2.4 mrad here.
    EXPECT_LT(std::abs(difference), 1e-4) << axis;
  }
  EXPECT_NE(exact["provenance"]["dbc_hash"], rounded["provenance"]["dbc_hash"]);
}

TEST(Exact, ATargetOfTheOtherTwinIsRefused) {
  const Ended ended = shell(fmt::format("{} run {}", HIL_BENCH_EXACT, scenario("transfer_alignment_quick")));
  EXPECT_EQ(ended.code, 2) << ended.out;
  EXPECT_THAT(ended.err, HasSubstr("target and bench are built from different DBC files"));
}

}  // namespace
}  // namespace canhil::test
