// Tests that the memory of the bench does not grow with the length of a run.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <regex>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

// Runs the bench with this number of IMU samples and with all reports. Returns the largest peak memory [KiB]
// of this run and all earlier runs.
long peak_kib(int samples) {
  constexpr double period_s = 0.005;
  const std::regex duration("duration_s = .*"), truth("trajectory = [^]*\\[initial_error\\]"),
      imu("\\[slave_imu\\]");
  std::string text = read(scenario("transfer_alignment_quick"));
  text = std::regex_replace(text, duration, fmt::format("duration_s = {}", samples * period_s));
  text = std::regex_replace(text, truth, "trajectory = \"rest\"\nheading_deg = 0.0\n\n[initial_error]");
  text = std::regex_replace(text, imu, "[slave_imu]\nperiod_ms = 5");
  const std::string name = scratch(fmt::format("{}", samples));
  std::ofstream(name + ".toml") << text;
  const Ended ended = hil_bench(
      fmt::format("run {0}.toml --bus in-process --json {0}.json --html {0}.html --csv {0}.csv", name));
  EXPECT_NE(ended.code, 2) << ended.err;
  EXPECT_EQ(read_json(name + ".json")["ending"]["completed"], true);
  rusage of_children{};
  getrusage(RUSAGE_CHILDREN, &of_children);
  return of_children.ru_maxrss;
}

// A series that is larger than 2 MiB is stored in a file (dbc/spool). The series of navigation answers have
// this size at 60 000 samples. A dozen other series reach this size only in longer runs: the series of filter
// answers, which have a tenth of the samples, and the series with 8 or 16 bytes per sample. If the bench kept
// all series in memory, 120 000 more samples would take 90 MiB.
TEST(Memory, OfARunDoesNotGrowWithIt) {
  const long before = peak_kib(60'000), after = peak_kib(180'000);
  EXPECT_GT(before, 0);
  EXPECT_LT(after, before + 26 * 1024L) << "was " << before;
}

}  // namespace
}  // namespace canhil::test
