// Tests the log of a run in virtual time, and what remains if the log cannot be written completely.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>

#include "dbc/logs/log.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Recording, TheLogOfVirtualTimeCarriesVirtualTime) {
  const std::string log = scratch("virtual.log");
  EXPECT_NE(
      hil_bench(fmt::format("run {} --bus in-process --log {}", scenario("transfer_alignment_quick"), log))
          .code,
      2);
  auto reader = LogReader::open(log);
  ASSERT_TRUE(reader);
  std::optional<std::int64_t> start_ns;
  for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
    if ((*entry)->frame.id != messages::Sync::info.id) continue;
    const auto sync = from_frame<messages::Sync>((*entry)->frame);
    if (!start_ns) start_ns = (*entry)->t_ns;
    ASSERT_EQ((*entry)->t_ns - *start_ns, static_cast<std::int64_t>(sync.time_us) * 1000);
  }
  EXPECT_TRUE(start_ns);
}

// A limit of the file size simulates a full disk. Only the log is larger than the limit.
TEST(Recording, ALogThatCannotBeWrittenToItsEndCostsNothingElse) {
  const std::string log = scratch("cut.log"), report = scratch("cut.xml");
  const Ended ended =
      shell(fmt::format("trap '' XFSZ; ulimit -f 200; {} run {} --bus in-process --log {} --junit {}",
                        HIL_BENCH, scenario("transfer_alignment_quick"), log, report));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr(log), HasSubstr("what was written is in '" + log + ".incomplete'")));
  EXPECT_THAT(ended.out, HasSubstr("not measured: "));
  EXPECT_THAT(read(report), HasSubstr("</testsuites>"));
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_GT(std::filesystem::file_size(log + ".incomplete"), 50'000U);
}

TEST(Run, ATerminalThatGoesAwayLeavesAReport) {
  const std::string report = scratch("hangup.json");
  const Ended ended = shell(fmt::format("timeout -s HUP --preserve-status 2 {} run {} --bus {} --json {}",
                                        HIL_BENCH, scenario("transfer_alignment_quick"), bus(), report));
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_EQ(read_json(report)["ending"]["detail"], "interrupted");
}

}  // namespace
}  // namespace canhil::test
