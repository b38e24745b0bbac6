// Tests runs in which the nodes are on two buses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "dbc/logs/log.hpp"
#include "dbc/ports/local_bus.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using Counts = std::map<std::string, int>;  // number of frames by message

int of(const Counts& counts, const std::string& message) {
  return counts.contains(message) ? counts.at(message) : 0;
}

// A bus that the test hosts. Therefore the test receives every frame of every sender without loss.
class WatchedBus {
 public:
  explicit WatchedBus(const std::string& which)
      : name(fmt::format("local:{}-{}", which, getpid())), hub_(host_local_bus(name, {}).value()) {}
  WatchedBus(const WatchedBus&) = delete;
  WatchedBus& operator=(const WatchedBus&) = delete;
  ~WatchedBus() { frames(); }

  /// Ends the bus, and returns how many frames of each message were on it.
  const Counts& frames() {
    stop_ = true;
    if (host_.joinable()) host_.join();
    hub_.reset();
    return frames_;
  }

  const std::string name;

 private:
  void host() {
    for (bool last = false; !last;) {
      last = stop_;
      while (const auto received = hub_->receive()) {
        const MessageInfo* info = messages::find_message(received->frame.id);
        ++frames_[info == nullptr ? fmt::format("id {:x}", received->frame.id) : std::string(info->name)];
      }
      if (!last) wait(*hub_, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 20'000'000);
    }
  }

  std::unique_ptr<LocalHub> hub_;
  Counts frames_;
  std::atomic<bool> stop_ = false;
  std::thread host_{[this] { host(); }};
};

struct Flown {
  Ended ended;
  nlohmann::json report;
  std::string main_name, aiding_name;
  Counts main, aiding;
};

// Flies the quick transfer alignment with the master INS on a separate bus. `command(bench, main)` returns
// the shell command that starts bench and target: `bench` is the command line of the bench, `main` is the bus
// of all other nodes. The run is repeated if the host disturbed it.
template <class Command>
Flown fly(const Command& command) {
  std::optional<Flown> flown;
  const auto once = [&] {
    WatchedBus main("main"), aiding("aiding");
    const std::string report = scratch("several.json");
    const std::string bench =
        fmt::format("{} run {} --bus {} --bus-of master_ins={} --json {}", HIL_BENCH,
                    scenario("transfer_alignment_quick"), main.name, aiding.name, report);
    const Ended ended = shell(command(bench, main.name));
    flown.emplace(Flown{.ended = ended,
                        .report = ended.code == 2 ? nlohmann::json() : read_json(report),
                        .main_name = main.name,
                        .aiding_name = aiding.name,
                        .main = main.frames(),
                        .aiding = aiding.frames()});
    return RealTimeRun{.report = flown->report, .answers_all = false};  // one hears nothing of the second
  };
  EXPECT_EQ(fly_undisturbed(once), "");
  EXPECT_NE(flown->ended.code, 2) << flown->ended.err;
  return std::move(*flown);
}

// In the flight of 3 s, the slave IMU sends 100 samples per second, and the master INS sends 10 per second.
// The bench sends a Sync with each IMU sample, and one more Sync at the start. The target answers each IMU
// sample and each master sample that it receives.
void expect_from_bench(const Flown& flown) {
  EXPECT_EQ(flown.aiding, (Counts{{"MasterInsVelocityNE", 30},
                                  {"MasterInsAttitude", 30},
                                  {"MasterInsLatitude", 30},
                                  {"MasterInsLongitude", 30},
                                  {"MasterInsVelocityD", 30}}));
  for (const auto& [message, count] : flown.aiding) EXPECT_EQ(of(flown.main, message), 0) << message;
  for (const char* message : {"SlaveImuDeltaTheta", "SlaveImuDeltaV", "SlaveImuStatus"})
    EXPECT_EQ(of(flown.main, message), 300) << message;
  EXPECT_EQ(of(flown.main, "Sync"), 301);
}

void expect_answers(const Flown& flown, int navigation, int updates) {
  EXPECT_EQ(figure(flown.report, "transfer_alignment", "answers", "answers"), navigation);
  EXPECT_EQ(figure(flown.report, "transfer_alignment", "answers", "updates"), updates);
  for (const char* message : {"AlignAttitude", "AlignVelocityNE", "AlignVelocityD"})
    EXPECT_EQ(of(flown.main, message), navigation) << message;
  for (const char* message : {"AlignInnovation", "AlignAccelBiasSigma", "AlignUpdate"})
    EXPECT_EQ(of(flown.main, message), updates) << message;
}

TEST(SeveralBuses, ATargetOnBothIsAlignedAndTheReportsSayWhoIsWhere) {
  const Flown flown = fly([](const std::string& bench, const std::string&) { return bench; });
  ASSERT_NE(flown.ended.code, 2) << flown.ended.err;
  expect_from_bench(flown);
  expect_answers(flown, 300, 30);
  EXPECT_EQ(flown.report["provenance"]["bus_of"]["MasterIns"], flown.aiding_name);
  EXPECT_THAT(flown.ended.out, HasSubstr(fmt::format("MasterIns on bus {}\n", flown.aiding_name)));
}

TEST(SeveralBuses, TheLogNamesTheBusThatEachFramePassedOn) {
  const std::string log = scratch("several.log");
  const Flown flown =
      fly([&](const std::string& bench, const std::string&) { return bench + " --log " + log; });
  ASSERT_NE(flown.ended.code, 2) << flown.ended.err;
  auto reader = LogReader::open(log);
  ASSERT_TRUE(reader) << reader.error().message;
  std::map<std::string, Counts> logged;
  for (auto entry = reader->next(); entry && *entry; entry = reader->next()) {
    const MessageInfo* info = messages::find_message((*entry)->frame.id);
    if (info != nullptr) ++logged[(*entry)->interface][std::string(info->name)];
  }
  EXPECT_EQ(logged[flown.aiding_name], flown.aiding);
  EXPECT_EQ(of(logged[flown.main_name], "SlaveImuStatus"), 300);
  EXPECT_EQ(of(logged[flown.main_name], "AlignAttitude"), 300);
  EXPECT_EQ(logged.size(), 2U);
}

TEST(SeveralBuses, ATargetThatListensOnTheFirstAloneHearsNothingOfTheSecond) {
  const Flown flown = fly([](const std::string& bench, const std::string& main) {
    return fmt::format("{} --bus {} & target=$!; {} --target none; code=$?; kill $target; exit $code",
                       HIL_TARGET, main, bench);
  });
  ASSERT_NE(flown.ended.code, 2) << flown.ended.err;
  expect_from_bench(flown);
  expect_answers(flown, 300, 0);
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
