// What a user sees if programs for CAN FD and programs for classic CAN use the same interface, or if an
// interface supports only classic CAN.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <linux/can.h>

#include "tests/processes/hil/program.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

TEST(Fd, AClassicInterfaceIsRefusedWithTheRemedy) {
  const Interface classic("vcan8", CAN_MTU);
  const std::string remedy = "`ip link set vcan8 type can ... fd on` (vcan: `ip link set vcan8 mtu 72`)";
  expect_one_line(hil_target("--bus vcan8 --dbc canhil-fd"), remedy);
  expect_one_line(
      hil_bench(fmt::format("run {} --bus vcan8 --dbc canhil-fd", scenario("transfer_alignment_quick"))),
      remedy);
}

/// Runs the command `then` while a target runs on vcan0. Returns the exit code and the stderr of the command,
/// then the stderr of the target.
std::string with_target(const std::string& options, const std::string& then) {
  const std::string said = scratch("target.err");
  const Ended ended = shell(
      fmt::format("{0} --bus vcan0 {1} 2>{2} & target=$!; sleep 0.5; {3}; code=$?; sleep 0.3; kill $target; "
                  "wait $target; exit $code",
                  HIL_TARGET, options, said, then));
  return fmt::format("{}\n{}{}", ended.code, ended.err, read(said));
}

std::string bench(const std::string& options) {
  return fmt::format("timeout 4 {} run {} --bus vcan0 --target none {}", HIL_BENCH,
                     scenario("transfer_alignment_quick"), options);
}

TEST(Fd, ATargetOfTheOtherContractIsNamedBeforeTheBenchGivesUp) {
  EXPECT_EQ(with_target("", bench("--dbc canhil-fd")),
            "2\nhil-bench: target on 'vcan0': answers in classic frames (canhil), expected CAN FD frames "
            "(canhil-fd)\n");
  EXPECT_EQ(with_target("--dbc canhil-fd", bench("")),
            "2\nhil-bench: target on 'vcan0': answers in CAN FD frames (canhil-fd), expected classic frames "
            "(canhil)\n");
}

TEST(Fd, ATargetReportsThatItHearsTheOtherContract) {
  EXPECT_EQ(
      with_target("", "cansend vcan0 0A0##10011223344556677"),
      "0\nhil-target: vcan0: received CAN FD frames (canhil-fd), 1 since the start, expected classic frames "
      "(canhil)\n");
  EXPECT_EQ(
      with_target("--dbc canhil-fd", "cansend vcan0 0A0#0011223344556677"),
      "0\nhil-target: vcan0: received classic frames (canhil), 1 since the start, expected CAN FD frames "
      "(canhil-fd)\n");
}

}  // namespace
}  // namespace canhil::test
