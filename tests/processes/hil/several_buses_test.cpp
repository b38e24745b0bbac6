// Nodes on buses of their own.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string two_buses() {
  return fmt::format("run {} --bus local:main-{} --bus-of master_ins=local:aiding-{} ",
                     scenario("transfer_alignment_quick"), getpid(), getpid());
}

TEST(SeveralBuses, ATargetOnBothIsAlignedAndTheReportsSayWhoIsWhere) {
  const std::string report = scratch("several.json");
  const Ended ended = hil_bench(two_buses() + "--json " + report);
  ASSERT_NE(ended.code, 2) << ended.err;
  const nlohmann::json page = read_json(report);
  EXPECT_TRUE(page["ending"]["completed"]) << page["ending"];
  EXPECT_GT(figure(page, "transfer_alignment", "answers", "answers"), 0);  // how many is the host's affair
  EXPECT_GT(figure(page, "transfer_alignment", "answers", "updates"), 0);
  EXPECT_EQ(page["provenance"]["bus_of"]["MasterIns"], fmt::format("local:aiding-{}", getpid()));
  EXPECT_THAT(ended.out, HasSubstr(fmt::format("MasterIns on bus local:aiding-{}\n", getpid())));
}

TEST(SeveralBuses, ATargetThatListensOnTheFirstAloneHearsNothingOfTheSecond) {
  const std::string report = scratch("first_only.json");
  const Ended ended =
      shell(fmt::format("{} {} --target none --json {} & sleep 0.5; {} --bus local:main-{}; wait $!",
                        HIL_BENCH, two_buses(), report, HIL_TARGET, getpid()));
  const nlohmann::json page = read_json(report);
  EXPECT_EQ(figure(page, "transfer_alignment", "answers", "updates"), 0) << ended.err;
  EXPECT_GT(figure(page, "transfer_alignment", "answers", "answers"), 0);
}

TEST(SeveralBuses, WhatCannotBeIsRefused) {
  const auto refused = [](const std::string& more, const std::string& what) {
    const Ended ended = hil_bench(fmt::format("run {} {}", scenario("transfer_alignment_quick"), more));
    EXPECT_EQ(ended.code, 2) << ended.out;
    EXPECT_THAT(ended.err, HasSubstr(what));
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  };
  for (const char* text : {"radar=local:b", "gps", "gps=", "=local:b", "target=local:b", "bench=local:b"})
    refused(fmt::format("--bus local:a --bus-of {}", text), "expected NODE=BUS with NODE one of");
  refused("--bus local:a --bus-of gps=local:b --lockstep", "one step over two buses has no order");
  refused("--bus in-process --bus-of gps=local:b", "one step over two buses has no order");
  refused("--bus local:a --bus-of slave_imu=local:a", "is the bus of all others");
  refused("--bus local:a --bus-of gps=local:b", "has no such node");
  const Ended target = hil_target("--bus local:nobody-a --bus local:nobody-b");
  EXPECT_EQ(target.code, 2);
  EXPECT_THAT(target.err, HasSubstr("local:nobody-a"));
}

}  // namespace
}  // namespace canhil::test
