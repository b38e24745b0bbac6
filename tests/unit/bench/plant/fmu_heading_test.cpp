// The heading of a ship as an FMU: the same trajectory as that of the plant that is built in.
#include <cmath>
#include <cstring>
#include <thread>

#include "tests/unit/bench/plant/heading_fmu.hpp"

namespace canhil {
namespace {

using test::heading_description;

constexpr double deg = 3.14159265358979323846 / 180;
const std::string keys =
    "heading_deg = 30\nspeed_mps = 7\nturn_time_constant_s = 4\nturn_gain_per_s = 0.3\nactuator_lag_s = 0.5\n"
    "actuator_rate_degps = 5\nactuator_stop_deg = 25\ngust_s = [2, 6]\ngust_degps2 = 0.4\n";

std::string parameters() {
  return fmt::format(
      "[plant.parameters]\nheading = {}\nspeed = 7\ntime_constant = 4\ngain = 0.3\nlag = 0.5\n"
      "rate_limit = {}\nstop = {}\ngust = {}\ngust_from = 2\ngust_to = 6\n",
      30 * deg, 5 * deg, 25 * deg, 0.4 * deg);
}

/// The outputs of all steps of 20 s, with a rudder that goes from side to side.
std::vector<double> trajectory(const plant::Plan& plan) {
  std::vector<double> all;
  auto made = plan.make({});
  EXPECT_TRUE(made) << made.error().message;
  if (!made) return all;
  constexpr std::int64_t step_us = 10'000;
  for (std::int64_t t_us = 0; t_us < 20'000'000; t_us += step_us) {
    const double rudder = 40 * deg * std::sin(static_cast<double>(t_us) * 1e-6);
    const auto done = (*made)->step(t_us, t_us + step_us, std::array{rudder});
    EXPECT_TRUE(done) << done.error().message;
    if (!done) return all;
    all.insert(all.end(), (*made)->outputs().begin(), (*made)->outputs().end());
  }
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(FmuHeading, IsThatOfThePlantThatIsBuiltIn) {
  const test::NothingLeft nothing_left;
  const auto built_in = test::read_plant(keys, "steered_heading");
  ASSERT_EQ(built_in.error, "");
  const std::vector<double> expected = trajectory(*built_in.plan);
  for (const int version : {2, 3}) {
    const std::string model = version == 2 ? "heading2" : "heading3";
    test::write_fmu(version, model, heading_description(version, model));
    const auto plan = test::plan_of(parameters());
    for (std::size_t i = 0; i < plan->outputs.size(); ++i)
      EXPECT_EQ(plan->outputs[i].si, built_in.plan->outputs[i].si) << plan->outputs[i].name;
    const std::vector<double> own = trajectory(*plan);
    ASSERT_EQ(own.size(), expected.size());
    for (std::size_t i = 0; i < own.size(); ++i) ASSERT_NEAR(own[i], expected[i], 1e-11) << i;
    // In another process, in this one, and again: the same bits.
    EXPECT_TRUE(same_bits(trajectory(*test::plan_of(parameters(), true)), own));
    EXPECT_TRUE(same_bits(trajectory(*plan), own));
  }
}

TEST(FmuHeading, AnEarlyReturnIsContinued) {
  const test::NothingLeft nothing_left;
  const auto built_in = test::read_plant(keys, "steered_heading");
  const std::vector<double> expected = trajectory(*built_in.plan);
  test::write_fmu(3, "early3", heading_description(3, "early3"));
  const std::vector<double> own = trajectory(*test::plan_of(parameters()));
  ASSERT_EQ(own.size(), expected.size());
  for (std::size_t i = 0; i < own.size(); ++i) ASSERT_NEAR(own[i], expected[i], 1e-6) << i;
}

TEST(FmuHeading, RunsInSeveralThreads) {
  const test::NothingLeft nothing_left;
  test::write_fmu(3, "heading3", heading_description(3, "heading3"));
  const auto plan = test::plan_of(parameters());
  std::vector<std::vector<double>> all(4);
  std::vector<std::thread> threads;
  for (auto& one : all) threads.emplace_back([&plan, &one] { one = trajectory(*plan); });
  for (auto& thread : threads) thread.join();
  for (const auto& one : all) EXPECT_TRUE(same_bits(one, all.front()));
}

}  // namespace
}  // namespace canhil
