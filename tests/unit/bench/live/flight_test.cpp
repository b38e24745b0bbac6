#include "bench/live/flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/checks/rule.hpp"
#include "bench/drive/contract.hpp"

namespace canhil::live {
namespace {

scenario::Scenario scenario(const std::string& name) {
  auto read = drive::read_scenario(std::string(SOURCE_DIR) + "/bench/flights/" + name + ".toml");
  EXPECT_TRUE(read) << read.error().message;
  return std::move(*read);
}

// Observes in the thread of the flight: processes each frame, and updates the shown flight every half second.
class LooksOn final : public drive::Onlooker {
 public:
  explicit LooksOn(Flight& flight) : flight_(flight) {}
  void departs(const drive::Departure& departure) override {
    of_ = &departure.per_run_truth;
    in_progress_.emplace(departure);
  }
  void landed() override {
    in_progress_->update(flight_, true, true);
    in_progress_.reset();
  }
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override {
    const world::PlantRecords growing = drive::growing_plants_of(*of_);
    for (std::size_t i = 0; i < growing.size(); ++i) {
      world::PlantRecord& copy = in_progress_->plants()[i];
      for (std::size_t row = copy.times_us().size(); row < growing[i]->times_us().size(); ++row) {
        std::vector<double> values;
        for (std::size_t column = 0; column < copy.columns().size(); ++column)
          values.push_back(growing[i]->value(column, row));
        copy.add(growing[i]->times_us()[row], values);
      }
      copy.ended_us = growing[i]->ended_us;
    }
    in_progress_->transmitted(frame, t_ns, late_ns);
  }
  void received(const Received& received) override { in_progress_->received(received); }
  void time_set(std::int64_t t_ns) override {
    in_progress_->time_set(t_ns);
    if (t_ns < next_ns_) return;
    in_progress_->update(flight_, true);
    next_ns_ = t_ns + 500'000'000;
  }

 private:
  Flight& flight_;
  const drive::PerRunTruth* of_ = nullptr;
  std::int64_t next_ns_ = 0;
  std::optional<FlightInProgress> in_progress_;
};

Result<drive::Run> fly(const scenario::Scenario& scenario, Flight* shown) {
  drive::Options options;
  options.bus = drive::BusName(std::string(drive::in_process_bus));
  std::optional<LooksOn> onlooker;
  if (shown != nullptr) {
    *shown = flight_of(scenario, options);
    options.onlookers = {&onlooker.emplace(*shown)};
  }
  const std::atomic<bool> stop = false;
  return drive::run(scenario, options, stop, [](std::int64_t) {});
}

// The flight is longer than the live view's window of ten seconds, so the window has to move.
class LiveFlight : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Estimators, LiveFlight,
                         testing::Values("transfer_alignment", "inflight_quick", "los_quick", "wind_quick"));

TEST_P(LiveFlight, ShowsTheNumbersOfTheReport) {
  const scenario::Scenario flown = scenario(GetParam());
  Flight shown;
  const auto run = fly(flown, &shown);
  ASSERT_TRUE(run) << run.error().message;
  const Flight report = flight_of(flown, *run);
  ASSERT_FALSE(report.series.empty());
  ASSERT_EQ(shown.series.size(), report.series.size());
  for (std::size_t i = 0; i < report.series.size(); ++i) {
    const report::Series &live = shown.series[i], &end = report.series[i];
    EXPECT_EQ(live.quantity, end.quantity);
    ASSERT_GE(live.points.size() + 2, end.points.size()) << end.quantity;  // the end of the run may add a gap
    std::size_t differing = 0;
    for (std::size_t k = 0; k < std::min(live.points.size(), end.points.size()); ++k) {
      const auto &a = live.points[k], &b = end.points[k];
      differing += a.t_s != b.t_s || a.low != b.low || a.high != b.high || a.sigma != b.sigma ? 1 : 0;
    }
    EXPECT_EQ(differing, 0U) << end.quantity;
  }
  EXPECT_EQ(shown.load_line.busiest, report.load_line.busiest);
  for (std::size_t i = 0; i < shown.checks.size(); ++i) {
    if (!shown.checks[i].outcome) continue;  // judged only at the end of the run
    EXPECT_EQ(shown.checks[i].outcome, report.checks[i].outcome) << shown.checks[i].name;
    EXPECT_EQ(shown.checks[i].measured, report.checks[i].measured) << shown.checks[i].name;
  }
}

TEST(LiveVerdict, JudgesAWindowWhenItIsOver) {
  scenario::Scenario flown = scenario("transfer_alignment");
  Flight shown;
  ASSERT_TRUE(fly(flown, &shown));
  const auto known =
      std::ranges::count_if(shown.checks, [](const CheckLine& c) { return c.outcome.has_value(); });
  const auto over = std::ranges::count_if(flown.checks, [&](const scenario::Check& check) {
    const auto bar = check.rule->bar();
    return bar && !bar->stretch.to_go_s && bar->stretch.window.to_us + 2'000'000 < flown.duration_us;
  });
  EXPECT_EQ(known, over);
}

TEST(LiveFlightOf, KnowsTheFaultsAndChecksBefore) {
  const scenario::Scenario flown = scenario("transfer_alignment_quick");
  const Flight flight = flight_of(flown, drive::Options{});
  EXPECT_EQ(flight.checks.size(), flown.checks.size());
  EXPECT_FALSE(flight.checks.front().outcome);
  EXPECT_EQ(flight.duration_s, 3.0);
}

}  // namespace
}  // namespace canhil::live
