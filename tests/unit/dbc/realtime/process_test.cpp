#include "dbc/realtime/process.hpp"

#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "dbc/command_line/command_line.hpp"
#include "dbc/realtime/command_line.hpp"
#include "dbc/realtime/host.hpp"

namespace canhil::realtime {
namespace {

using testing::HasSubstr;

TEST(Words, SayWhatIsInForce) {
  Standing standing{.policy = "SCHED_FIFO",
                    .priority = 40,
                    .cpus = {2, 3},
                    .locked_kib = 72'704,
                    .timer_slack_ns = 1,
                    .awake = true,
                    .governors = {"performance"},
                    .preemption = "PREEMPT_RT"};
  EXPECT_EQ(to_text(standing),
            "SCHED_FIFO 40, CPU 2-3, 71 MiB locked, timer slack 1 ns, no deep sleep, governor performance, "
            "PREEMPT_RT");
  EXPECT_EQ(frequency_warning(standing), "");
  standing.governors = {"performance", "ondemand"};
  EXPECT_THAT(frequency_warning(standing),
              HasSubstr("CPU 2-3 follows the load (governor performance, ondemand)"));
}

TEST(Standing, IsThatOfThisProcess) {
  const Standing now = standing();
  EXPECT_EQ(now.policy == "SCHED_FIFO", sched_getscheduler(0) == SCHED_FIFO);
  EXPECT_EQ(now.cpus, cpus());
  EXPECT_FALSE(now.awake);
}

TEST(Cpu, OneThatThisProcessHasNotIsNamedWithThoseThatItHas) {
  EXPECT_TRUE(check_cpu("--cpu", cpus().front()));
  const auto refused = check_cpu("--cpu", 1023);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              HasSubstr("--cpu 1023: this process may not run there, expected one of "));
}

long page_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// The sanitizers replace mlockall by a function that does nothing, because the terabytes of their shadow
// memory cannot be locked.
#ifdef CANHIL_SANITIZED
constexpr bool memory_is_locked = false;
#else
constexpr bool memory_is_locked = true;
#endif

TEST(OwnMemory, CostsNoFaultsAfterAFork) {
  constexpr std::size_t pages = 500, page_bytes = 4096;
  std::vector<char> memory(pages * page_bytes, 1);
  const auto faults_of_writing = [&] {
    const long before = page_faults();
    for (std::size_t at = 0; at < memory.size(); at += page_bytes) {
      const_cast<volatile char&>(memory[at]) = 2;
    }
    return page_faults() - before;
  };
  const auto fork_once = [] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
  };
  fork_once();
  EXPECT_GE(faults_of_writing(), long{pages} / 2) << "the page faults that this is about";
  fork_once();
  if (!own_memory_again()) {
    EXPECT_NE(missing_rights(1), "");
    return;
  }
  if (memory_is_locked) {
    EXPECT_LE(faults_of_writing(), 10);
  }
  ::munlockall();
}

std::string parse(const std::string& line, Options& options) {
  command_line::Program program("");
  add_options(program, options);
  std::istringstream text("program " + line);
  const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const auto parsed = program.parse(static_cast<int>(argv.size()), argv.data());
  return parsed ? "" : parsed.error().message;
}

TEST(CommandLine, AsksForNothingUnlessGivenAnOption) {
  Options options;
  EXPECT_EQ(parse("", options), "");
  EXPECT_FALSE(options.request());
  EXPECT_EQ(parse("--realtime", options), "");
  ASSERT_TRUE(options.request());
  EXPECT_EQ(options.request()->priority, default_priority);
  EXPECT_FALSE(options.request()->cpu);
}

TEST(CommandLine, TakesPriorityAndCpu) {
  Options options;
  EXPECT_EQ(parse("--realtime --priority 080 --cpu 3", options), "");
  EXPECT_EQ(options.request()->priority, 80) << "decimal";
  EXPECT_EQ(options.request()->cpu, 3);
}

TEST(CommandLine, RefusesWhatIsNoPriorityAndWhatLacksRealtime) {
  for (const char* number : {"0", "100", "-1", "1e1", "0x10", "99999999999"}) {
    Options options;
    EXPECT_THAT(parse(std::string("--realtime --priority ") + number, options),
                HasSubstr("is not a whole number from 1 to 99"));
  }
  Options options;
  EXPECT_THAT(parse("--cpu 1", options), HasSubstr("requires --realtime"));
}

}  // namespace
}  // namespace canhil::realtime
