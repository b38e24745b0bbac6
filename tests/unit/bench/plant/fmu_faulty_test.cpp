// FMUs that fail, crash or hang while they run: one error that names the FMU and the time, and nothing is
// left.
#include <sys/prctl.h>
#include <sys/types.h>
#include <unistd.h>
#include <csignal>

#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "tests/unit/bench/plant/made_fmu.hpp"

namespace canhil {
namespace {

using test::Described;

enum Fault { nothing, fails, discards, is_fatal, hangs, crashes, exits, writes_nan, fails_at_start, ends };

void write_faulty(int version,
                  const std::string& capabilities = "canHandleVariableCommunicationStepSize='true'") {
  const std::string model = version == 2 ? "faulty2" : "faulty3";
  const std::vector<Described> all{{"what", 0, "Int32", "parameter", "start='0'", "variability='fixed'"},
                                   {"at_s", 1, "Float64", "parameter", "start='1'", "variability='fixed'"},
                                   {"y", 2, "Float64", "output"}};
  test::write_fmu(version, model, test::description_of(version, model, all, "", capabilities));
}

/// The error of a run of 0.3 s in steps of 0.1 s; the fault is in the second. A start with a sanitizer on
/// busy cores can take a second.
std::string error_of_run(Fault fault, bool in_process = false) {
  const auto plan = test::plan_of(
      fmt::format("answers_within_s = 2\nparameters = {{ what = {}, at_s = 0.2 }}\n", int{fault}),
      in_process);
  auto made = plan->make({});
  if (!made) return made.error().message;
  for (std::int64_t t_us = 0; t_us < 300'000; t_us += 100'000) {
    const auto done = (*made)->step(t_us, t_us + 100'000, {});
    if (!done) return done.error().message;
    EXPECT_DOUBLE_EQ((*made)->outputs().front(), static_cast<double>(t_us + 100'000) / 1e6);
  }
  return "";
}

class FaultyFmu : public testing::TestWithParam<int> {
 protected:
  const test::NothingLeft nothing_left_;
  void SetUp() override { write_faulty(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Fmi, FaultyFmu, testing::Values(2, 3));

TEST_P(FaultyFmu, ReturnsAnError) {
  const std::string start = "FMU 'model.fmu' in the step from 0.1 s to 0.2 s: ";
  // FMI 2.0 formats the messages as printf does.
  const std::string message = std::string("; the FMU's last message: the valve is stuck\\nat the stop") +
                              (GetParam() == 2 ? " (42)" : "");
  for (const bool in_process : {false, true}) {
    EXPECT_EQ(error_of_run(nothing, in_process), "");
    EXPECT_EQ(error_of_run(fails, in_process),
              fmt::format("{}fmi{}DoStep returned error{}", start, GetParam(), message));
    EXPECT_EQ(error_of_run(discards, in_process),
              fmt::format("{}fmi{}DoStep returned discard{}", start, GetParam(), message));
    EXPECT_EQ(error_of_run(is_fatal, in_process),
              fmt::format("{}fmi{}DoStep returned fatal{}", start, GetParam(), message));
    EXPECT_EQ(error_of_run(ends, in_process),
              fmt::format("{}fmi{}DoStep asked for the end of the simulation", start, GetParam()));
    EXPECT_EQ(error_of_run(writes_nan, in_process), start + "output 'y' is nan");
    EXPECT_EQ(
        error_of_run(fails_at_start, in_process),
        fmt::format("FMU 'model.fmu' at its start: fmi{}ExitInitializationMode returned error; the FMU's "
                    "last message: no such luck{}",
                    GetParam(), GetParam() == 2 ? " (42)" : ""));
  }
}

TEST_P(FaultyFmu, EndsItsProcess) {
  const std::string start = "FMU 'model.fmu' in the step from 0.1 s to 0.2 s: its process ";
  EXPECT_EQ(error_of_run(crashes), start + "ended by SIGSEGV (Segmentation fault)");
  EXPECT_EQ(error_of_run(exits), start + "exited with 3");
}

TEST_P(FaultyFmu, Hangs) {
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(error_of_run(hangs),
            "FMU 'model.fmu' in the step from 0.1 s to 0.2 s: did not answer within 2 s and was killed");
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(10));
}

// A bench that is killed cannot clean up: the process of the FMU does it, even if the FMU hangs.
TEST_P(FaultyFmu, TheBenchIsKilled) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // this process sees the end of the FMU's process
  for (const Fault fault : {nothing, hangs}) {
    int started[2];
    ASSERT_EQ(pipe(started), 0);
    const pid_t bench = fork();
    if (bench == 0) {
      const auto plan = test::plan_of(fmt::format("parameters = {{ what = {}, at_s = 0.1 }}\n", int{fault}));
      auto made = plan->make({});
      static_cast<void>(!write(started[1], "x", 1));
      if (fault == hangs) static_cast<void>((*made)->step(0, 100'000, {}));
      pause();
    }
    const auto until = [](const auto& condition) {
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (!condition() && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return condition();
    };
    char x = 0;
    ASSERT_EQ(read(started[0], &x, 1), 1);
    EXPECT_FALSE(nothing_left_.empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until the FMU hangs
    kill(bench, SIGKILL);
    ASSERT_EQ(waitpid(bench, nullptr, 0), bench);
    EXPECT_TRUE(until([&] { return nothing_left_.empty(); }));
    close(started[0]);
    close(started[1]);
    EXPECT_TRUE(until([] { return waitpid(-1, nullptr, WNOHANG) < 0; }));
  }
}

TEST(FmuStep, IsTheDefaultExperiments) {
  const test::NothingLeft nothing_left;
  const auto step_of = [](const std::string& definitions, const std::string& capabilities = "") {
    test::write_fmu(
        3, "faulty3",
        test::description_of(3, "faulty3", {{"y", 2, "Float64", "output"}}, definitions, capabilities));
    return test::plan_of()->step_us;
  };
  EXPECT_EQ(step_of("<DefaultExperiment stepSize='5e-3'/>", "fixedInternalStepSize='1e-3'"), 5'000);
  EXPECT_EQ(step_of("", "fixedInternalStepSize='0.25'"), 250'000);
  EXPECT_EQ(step_of("<DefaultExperiment stopTime='1'/>"), 10'000);
}

TEST(FmuStep, MayNotVaryIfTheFmuCannot) {
  const test::NothingLeft nothing_left;
  write_faulty(3, "fixedInternalStepSize='0.002'");
  const auto plan = test::plan_of();
  auto made = plan->make({});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_TRUE((*made)->step(0, 4'000, {}));
  const auto varied = (*made)->step(4'000, 6'000, {});
  ASSERT_FALSE(varied);
  EXPECT_EQ(
      varied.error().message,
      "FMU 'model.fmu' in the step from 0.004 s to 0.006 s: the steps before took 0.004 s, expected this "
      "step to be equal, because canHandleVariableCommunicationStepSize is false");
  auto other = plan->make({});
  ASSERT_TRUE(other);
  const auto odd = (*other)->step(0, 3'000, {});
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().message,
            "FMU 'model.fmu' in the step from 0 s to 0.003 s: expected a step that is a multiple of "
            "fixedInternalStepSize, 0.002 s");
}

}  // namespace
}  // namespace canhil
