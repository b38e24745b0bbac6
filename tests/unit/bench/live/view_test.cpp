#include "bench/live/view.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "bench/drive/contract.hpp"
#include "bench/live/server.hpp"

namespace canhil::live {
namespace {

// The last snapshot that was shown. Until the view is closed, only the thread of the view uses the snapshot.
struct Shown {
  Snapshot last;
  std::atomic<int> times = 0;
};
class Screen final : public Display {
 public:
  explicit Screen(Shown& shown) : shown_(shown) {}
  void show(const Snapshot& snapshot) override {
    shown_.last = snapshot;
    ++shown_.times;
  }
  void run_for(std::chrono::milliseconds time) override { std::this_thread::sleep_for(time); }

 private:
  Shown& shown_;
};

std::vector<std::unique_ptr<Display>> one(Shown& shown) {
  std::vector<std::unique_ptr<Display>> displays;
  displays.push_back(std::make_unique<Screen>(shown));
  return displays;
}

TEST(LiveView, ShowsAFlightAndItsEnd) {
  const auto scenario =
      drive::read_scenario(std::string(SOURCE_DIR) + "/bench/flights/transfer_alignment_quick.toml");
  ASSERT_TRUE(scenario) << scenario.error().message;
  drive::Options options;
  options.bus = drive::BusName(std::string(drive::in_process_bus));
  Shown shown;
  View view(one(shown), {.flight = flight_of(*scenario, options)});
  options.onlookers = {&view.onlooker()};
  const std::atomic<bool> stop = false;
  const auto run = drive::run(*scenario, options, stop, [](std::int64_t) {});
  ASSERT_TRUE(run) << run.error().message;
  view.show(flight_of(*scenario, *run));
  view.close();
  ASSERT_TRUE(shown.last.flight);
  EXPECT_EQ(shown.last.flight->outcome, run->verdict.outcome);
  EXPECT_GT(shown.last.frames + shown.last.dropped, 1000U);
  EXPECT_FALSE(shown.last.flight->series.empty());
}

TEST(LiveView, ShowsABatchFromAnyThread) {
  Shown shown;
  View view(one(shown), {.batch = Batch{.title = "many", .of = "runs", .total = 100}});
  std::vector<std::thread> workers;
  for (int i = 0; i < 4; ++i) {
    workers.emplace_back([&view] {
      for (std::uint64_t done = 0; done < 100; ++done)
        view.show(Batch{.title = "many", .of = "runs", .done = done, .total = 100});
    });
  }
  for (std::thread& worker : workers) worker.join();
  view.show(Batch{.title = "many", .of = "runs", .done = 100, .total = 100});
  view.close();
  EXPECT_EQ(shown.last.batch->done, 100U);
}

TEST(LiveServer, RefusesAPortInUse) {
  const auto first = Server::open(loopback_address, 0);
  ASSERT_TRUE(first) << first.error().message;
  const std::string url = (*first)->url();
  const auto port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  const auto second = Server::open(loopback_address, port);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("the port is in use"), std::string::npos);
  EXPECT_FALSE(Server::open("not an address", 0));
  EXPECT_FALSE(Server::open("192.0.2.1", 0));  // TEST-NET-1 (RFC 5737), not an address of this machine
}

}  // namespace
}  // namespace canhil::live
