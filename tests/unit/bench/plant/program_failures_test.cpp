// Programs with one defect each: the error names the program, the time and the reason, and no process is
// left.
#include <gmock/gmock.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>

#include "tests/unit/bench/plant/read_plan.hpp"
#include "tests/unit/bench/plant/scripts.hpp"

namespace canhil::plant {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Where an answer is expected, the machine may be busy.
const std::string patient = "answers_within_s = 60\nstarts_within_s = 60\n";
const std::string impatient = "answers_within_s = 1\nstarts_within_s = 60\n";

// A script whose processes write their ids to a file; they must have ended afterwards.
class ProgramWithADefect : public testing::Test {
 protected:
  static std::string command(const std::string& lines, const std::string& patience = patient) {
    test::script("defect.sh", "echo $$ >> ids\n" + lines);
    return "command = './defect.sh'\n" + patience;
  }
  // What is reported when the scenario is read.
  static std::string at_reading(const std::string& lines) {
    return read_plan("program", command(lines)).error;
  }
  // What is reported at the first step, after which it behaves as `lines` says.
  static std::string at_step(const std::string& lines, const std::string& patience = patient) {
    const auto plan = good_plan(
        "program", command(test::up_to_first_step + "[ \"$step\" = end ] && exit\n" + lines, patience));
    if (plan == nullptr) return "no plan";
    const auto plant = made(*plan);
    if (plant == nullptr) return "no plant";
    const auto done = plant->step(10'000, 30'000, std::vector{0.0});
    return done ? "no error" : done.error().message;
  }
  void TearDown() override {
    std::ifstream ids(test::own_folder() + "/ids");
    int number = 0;
    for (pid_t id = 0; ids >> id; ++number) EXPECT_FALSE(kill(id, 0) == 0 || errno != ESRCH) << id;
    EXPECT_EQ(number, expected_processes);
    std::filesystem::remove(test::own_folder() + "/ids");
  }
  int expected_processes = 1;
};

TEST_F(ProgramWithADefect, AtItsStart) {
  const std::string where =
      test::own_folder() + "/x.toml:2: key 'plant.command': program './defect.sh' at its start: ";
  EXPECT_EQ(at_reading("exit 3"), where + "exited with 3; it had written no line");
  EXPECT_EQ(
      at_reading("echo hello; sleep 10"),
      where +
          "wrote 'hello': not a declaration, expected 'input NAME UNIT', 'output NAME UNIT' or 'state' and "
          "numbers");
  EXPECT_EQ(at_reading("echo state; sleep 10"), where + "declares no output, expected at least one");
  EXPECT_EQ(at_reading("echo output a m; echo state; sleep 10"),
            where + "wrote 'state': the number of values is 0, expected 1");
  EXPECT_EQ(read_plan("program", command("echo output a m; sleep 10", "starts_within_s = 1\n")).error,
            where + "did not answer within 1 s; its last line was 'output a m'");
  EXPECT_EQ(at_reading("echo error mass is negative; exit 1"), where + "reports 'mass is negative'");
  expected_processes = 6;
}

TEST_F(ProgramWithADefect, ThatEndsEarly) {
  const std::string where = "program './defect.sh' at 0.03 s: ";
  EXPECT_EQ(at_step("exit 3"), where + "exited with 3; its last line was 'state 1 2'");
  EXPECT_EQ(at_step("kill -SEGV $$"),
            where + "ended by SIGSEGV (Segmentation fault); its last line was 'state 1 2'");
  EXPECT_EQ(at_step("printf 'state 3'; exit 0"), where + "exited with 0; 'state 3' has no line end");
  EXPECT_EQ(at_step("exec 1>&-; sleep 10"),
            where + "closed its standard output; its last line was 'state 1 2'");
  EXPECT_EQ(at_step("echo error the tank is empty; exit 0"), where + "reports 'the tank is empty'");
  expected_processes = 10;
}

TEST_F(ProgramWithADefect, ThatEndsBetweenTwoSteps) {
  const auto plan = good_plan("program", command(test::up_to_first_step + "echo state 3 4; exit 5"));
  const auto plant = made(*plan);
  ASSERT_TRUE(plant->step(0, 10'000, std::vector{0.0}));
  EXPECT_EQ(plant->step(10'000, 20'000, std::vector{0.0}).error().message,
            "program './defect.sh' at 0.02 s: exited with 5; its last line was 'state 3 4'");
  expected_processes = 2;
}

TEST_F(ProgramWithADefect, ThatAnswersNothing) {
  // Also a process that it started, and that ignores signals, is killed.
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(at_step("trap '' TERM HUP INT\n(trap '' TERM; echo $(exec sh -c 'echo $PPID') >> ids; sleep 60) "
                    "&\nsleep 60",
                    impatient),
            "program './defect.sh' at 0.03 s: did not answer within 1 s; its last line was 'state 1 2'");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  expected_processes = 3;
}

TEST_F(ProgramWithADefect, ThatIsStopped) {
  EXPECT_THAT(at_step("kill -STOP $$", impatient), HasSubstr("did not answer within 1 s"));
  expected_processes = 2;
}

TEST_F(ProgramWithADefect, ThatWritesSomethingElse) {
  const std::string where = "program './defect.sh' at 0.03 s: ";
  EXPECT_EQ(at_step("echo level 3; read step"), where + "wrote 'level 3', expected 'state' and 2 numbers");
  EXPECT_EQ(at_step("echo state 3; read step"),
            where + "wrote 'state 3': the number of values is 1, expected 2");
  EXPECT_EQ(at_step("echo state 3 nan; read step"), where + "wrote nan for 'flow', expected a finite number");
  EXPECT_THAT(at_step("head -c 1000000 /dev/zero"), StartsWith(where + "wrote '\\x00\\x00"));
  EXPECT_THAT(at_step("yes x | tr -d '\\n'"), HasSubstr("more than 65536 bytes without a line end"));
  expected_processes = 10;
}

TEST_F(ProgramWithADefect, ThatWritesMoreThanItIsAskedFor) {
  for (const std::string too_much : {"printf 'state 3 4\\nstate 5 6\\n'; sleep 10", "yes state 5 6"}) {
    const auto plan =
        good_plan("program", command(test::up_to_first_step + "[ \"$step\" = end ] && exit\n" + too_much));
    const auto plant = made(*plan);
    ASSERT_TRUE(plant->step(0, 10'000, std::vector{0.0}));
    EXPECT_EQ(plant->step(10'000, 20'000, std::vector{0.0}).error().message,
              "program './defect.sh' at 0.02 s: wrote 'state 5 6' without being asked, expected one line for "
              "each step");
  }
  expected_processes = 4;
}

TEST_F(ProgramWithADefect, ThatDeclaresOtherOutputsInTheRun) {
  const auto plan = good_plan("program", command("[ -e second ] && name=other || name=level; touch second\n"
                                                 "echo output $name m; echo state 1; read step"));
  ASSERT_NE(plan, nullptr);
  EXPECT_EQ(
      plan->make({}).error().message,
      "program './defect.sh' at its start: declares other inputs or outputs than when the scenario was read, "
      "expected the same");
  std::filesystem::remove(test::own_folder() + "/second");
  expected_processes = 2;
}

TEST_F(ProgramWithADefect, ThatDoesNotEndIsKilledAtTheEnd) {
  {
    const auto plan = good_plan("program", command(test::up_to_first_step + "trap '' TERM; yes state"));
    ASSERT_NE(plan, nullptr);
  }
  expected_processes = 1;
}

TEST(Program, ThatCannotBeStartedIsReported) {
  const auto error = [](const std::string& command) {
    return read_plan("program", "command = '" + command + "'\n").error;
  };
  const std::string from = ", expected an executable file (from " + test::own_folder() + "/)";
  EXPECT_THAT(error("./none"), HasSubstr("program './none' at its start: No such file or directory" + from));
  EXPECT_THAT(error("no-such-program"), HasSubstr("No such file or directory" + from));
  EXPECT_THAT(error("/tmp"), HasSubstr("Is a directory"));
  std::ofstream(test::own_folder() + "/plain.txt") << "x\n";
  EXPECT_THAT(error("./plain.txt"), HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace canhil::plant
