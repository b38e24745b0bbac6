#include "dbc/realtime/host.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/own_folder.hpp"

namespace canhil::realtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Preemption, IsReadFromTheVersionOfTheKernel) {
  EXPECT_EQ(preemption("#1 SMP PREEMPT_RT Debian 6.1.90-1 (2024-05-03)"), "PREEMPT_RT");
  EXPECT_EQ(preemption("#1 SMP PREEMPT RT Debian 4.19.1"), "PREEMPT_RT");
  EXPECT_EQ(preemption("#1 SMP PREEMPT_DYNAMIC Debian 6.1.90-1"), "PREEMPT_DYNAMIC");
  EXPECT_EQ(preemption("#1 SMP PREEMPT Mon Jan 1"), "PREEMPT");
  EXPECT_EQ(preemption("#1 Debian 6.1.90-1"), "none or voluntary");
}

// CPUs 0 and 2 have frequency scaling on demand, CPU 1 has a fixed frequency, CPU 3 has no frequency scaling.
class Governors : public testing::Test {
 protected:
  void SetUp() override {
    governs(0, "ondemand");
    governs(1, "performance");
    governs(2, "ondemand");
    std::filesystem::create_directories(folder_ + "/cpu3");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void governs(int cpu, const std::string& governor) const {
    const std::string folder = fmt::format("{}/cpu{}/cpufreq", folder_, cpu);
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/scaling_governor") << governor << '\n';
  }
  const std::string folder_ = test::own_folder() + "/cpus";
};

TEST_F(Governors, AreThoseOfTheCpusAskedForEachOnce) {
  EXPECT_THAT(governors({0, 1, 2, 3}, folder_), ElementsAre("ondemand", "performance"));
  EXPECT_THAT(governors({1}, folder_), ElementsAre("performance"));
  EXPECT_THAT(governors({3}, folder_), IsEmpty());
}

TEST_F(Governors, OnlySomeFollowTheLoad) {
  EXPECT_TRUE(scales_with_load(governors({0, 1}, folder_)));
  EXPECT_FALSE(scales_with_load(governors({1}, folder_)));
  EXPECT_FALSE(scales_with_load(governors({3}, folder_)));
  EXPECT_TRUE(scales_with_load({"schedutil"}));
}

TEST(ListOfCpus, IsAsTheKernelWritesIt) {
  EXPECT_EQ(list({}), "");
  EXPECT_EQ(list({4}), "4");
  EXPECT_EQ(list({0, 1, 2, 6, 8, 9}), "0-2,6,8-9");
}

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

TEST(MissingRights, AreNoneByLimitsOrByCapabilities) {
  EXPECT_EQ(missing({.priority = 40, .locked_bytes = unlimited}, 40, "ann", "/opt/p"), "");
  EXPECT_EQ(missing({.may_schedule = true, .may_lock = true}, 99, "ann", "/opt/p"), "");
}

TEST(MissingRights, AreNamedWithTheirRemedy) {
  const std::string remedy =
      ": add the lines 'ann - rtprio 40' and 'ann - memlock unlimited' to "
      "/etc/security/limits.d/canhil.conf and log in again, or `sudo setcap cap_sys_nice,cap_ipc_lock+ep "
      "/opt/p`";
  EXPECT_EQ(missing({.priority = 39, .locked_bytes = unlimited}, 40, "ann", "/opt/p"),
            "real-time priority 40 is above the limit of 39" + remedy);
  EXPECT_EQ(missing({.priority = 99, .locked_bytes = 8 << 20}, 40, "ann", "/opt/p"),
            "the limit of 8192 KiB does not allow locking all memory" + remedy);
  const std::string both = missing({.may_lock = true}, 40, "ann", "/opt/p");
  EXPECT_THAT(both, HasSubstr("real-time priority"));
  EXPECT_THAT(both, Not(HasSubstr("memory cannot")));
}

}  // namespace
}  // namespace canhil::realtime
