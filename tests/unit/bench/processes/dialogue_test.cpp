#include "bench/processes/dialogue.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/own_folder.hpp"

namespace canhil::processes {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
using Outcome = Dialogue::Outcome;

Dialogue shell(const std::string& command, StartOptions options = {}) {
  auto started = Dialogue::start("/bin/sh", {"sh", "-c", command}, std::move(options));
  EXPECT_TRUE(started) << started.error().message;
  return std::move(*started);
}

std::string until_closed(Dialogue& dialogue) {
  std::string all;
  Outcome outcome = Outcome::done;
  while (outcome == Outcome::done) outcome = dialogue.receive(all, steady_clock::now() + 10s);
  EXPECT_EQ(outcome, Outcome::closed);
  return all;
}

TEST(Dialogue, CarriesBytesBothWays) {
  Dialogue cat = shell("exec cat");
  std::string large(300'000, 'x'), received;  // more than the pipes hold
  std::thread reader([&] {
    while (received.size() < large.size() &&
           cat.receive(received, steady_clock::now() + 10s) == Outcome::done) {
    }
  });
  EXPECT_EQ(cat.send(large, steady_clock::now() + 10s), Outcome::done);
  reader.join();
  EXPECT_EQ(received, large);
  cat.close_input();
  EXPECT_EQ(until_closed(cat), "");
}

TEST(Dialogue, WaitsNoLongerThanTheDeadline) {
  Dialogue sleeper = shell("exec sleep 30");
  const auto begin = steady_clock::now();
  std::string received;
  EXPECT_EQ(sleeper.receive(received, Dialogue::Time::min()), Outcome::late);
  EXPECT_EQ(sleeper.receive(received, begin + 50ms), Outcome::late);
  EXPECT_EQ(sleeper.send(std::string(1'000'000, 'x'), begin + 100ms), Outcome::late);
  EXPECT_LT(steady_clock::now() - begin, 10s);
}

TEST(Dialogue, WithAProgramThatHasEndedEndsNotTheBench) {
  std::signal(SIGPIPE, SIG_DFL);
  Dialogue ended = shell("exit 3");
  EXPECT_EQ(until_closed(ended), "");
  while (!ended.process()->ended())
    std::this_thread::sleep_for(1ms);  // its streams close one after the other
  EXPECT_EQ(ended.send("x", steady_clock::now() + 10s), Outcome::closed);
  EXPECT_EQ(to_text(ended.process()->end(1000ms)), "exited with 3");
}

TEST(Dialogue, RunsInTheFolderThatIsAskedFor) {
  Dialogue place = shell("pwd -P", {.folder = test::own_folder()});
  EXPECT_EQ(until_closed(place), std::filesystem::canonical(test::own_folder()).string() + "\n");
}

TEST(Dialogue, WithAProgramThatIsNotThereGivesTheReasonOfTheKernel) {
  EXPECT_EQ(Dialogue::start("/no/such/program", {"x"}).error().message, "No such file or directory");
}

// A bench that was started with `<&-` has pipes with the number 0.
TEST(Dialogue, WorksWithoutAStandardInputOfTheBench) {
  const pid_t bench = fork();
  if (bench == 0) {
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    Dialogue cat = shell("exec cat");
    std::string received;
    cat.send("x\n", steady_clock::now() + 10s);
    cat.receive(received, steady_clock::now() + 10s);
    _exit(received == "x\n" ? 0 : 1);
  }
  int status = -1;
  waitpid(bench, &status, 0);
  EXPECT_EQ(status, 0);
}

// The bench is a process of its own here, and is killed.
TEST(Dialogue, EndsTheProgramIfTheBenchIsKilled) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t bench = fork();
  if (bench == 0) {
    close(report[0]);
    Dialogue deaf = shell("trap '' TERM HUP; exec sleep 100", {.signal_at_death = SIGKILL});
    const pid_t id = deaf.process()->id();
    static_cast<void>(!write(report[1], &id, sizeof id));
    pause();
  }
  close(report[1]);
  pid_t program = 0;
  ASSERT_EQ(read(report[0], &program, sizeof program), static_cast<ssize_t>(sizeof program));
  close(report[0]);
  EXPECT_EQ(kill(program, 0), 0);
  kill(bench, SIGKILL);
  waitpid(bench, nullptr, 0);
  const auto alive = [&] {
    waitpid(program, nullptr, WNOHANG);  // if this test is a subreaper, the program is now its child
    return kill(program, 0) == 0;
  };
  for (int i = 0; i < 500 && alive(); ++i) std::this_thread::sleep_for(10ms);
  EXPECT_FALSE(alive());
}

}  // namespace
}  // namespace canhil::processes
