// The uncertainty budget, against numbers calculated by hand.
#include "bench/report/uncertainty.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/report/page.hpp"
#include "tests/unit/bench/report/finished_run.hpp"

namespace canhil::report {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double us = 1e-6;

// A latency of 1 ms, measured while the bench was 30 us late, in a bucket of 1 us.
std::array<double, 5> of(const StampConditions& conditions) {
  return half_widths_s(conditions, 1000 * us, 30 * us, 1 * us);
}

TEST(Uncertainty, OfTheKernelsStampsAt500KbitPerSecond) {
  const auto half = of({.bit_s = 2 * us});
  // The half-widths are: half of the resolution of 1 ns, 500 ppm of 1 ms, the bench's lateness, the duration
  // of a bit, and half of a bucket.
  EXPECT_THAT(half, ElementsAre(0.5e-9, testing::DoubleNear(0.5 * us, 1e-15), 30 * us, 2 * us, 0.5 * us));
  // u^2 = (2 * 0.0005^2 + 0.5^2 + 30^2 + 2^2 + 0.5^2) / 3 = 904.5000005 / 3 us^2
  EXPECT_NEAR(combined_s(half), 17.363755 * us, 1e-12);
}

TEST(Uncertainty, OfTheControllersStampsTheHostHasNoPart) {
  const auto half = of({.hardware = true, .usb_poll_s = 0, .bit_s = 2 * us});
  // The resolution of 1 us counts twice, once for each stamp. The clock contributes 100 ppm of 1 ms. Together
  // with a bit and half of a bucket, u^2 = (2 * 0.25 + 0.01 + 4 + 0.25) / 3 = 4.76 / 3 us^2.
  EXPECT_EQ(half[static_cast<std::size_t>(Influence::host)], 0);
  EXPECT_NEAR(combined_s(half), 1.259630 * us, 1e-12);
}

TEST(Uncertainty, OfAUsbAdapterIsItsPolling) {
  const auto half = of({.usb_poll_s = 1000 * us});
  EXPECT_EQ(half[0], 500 * us);
  // For two stamps, the half-width of 500 us gives 500 us * sqrt(2 / 3) = 500 us * 0.81649658.
  EXPECT_NEAR(standard_s(Influence::stamps, half[0]), 408.248290 * us, 1e-12);
  // u^2 = (2 * 500^2 + 0.25 + 900 + 0.25) / 3 = 500900.5 / 3 us^2
  EXPECT_NEAR(combined_s(half), 408.615753 * us, 1e-12);
}

TEST(Uncertainty, OfASimulatedWireHasNoHost) { EXPECT_EQ(of({.simulated_wire = true})[2], 0); }

TEST(Uncertainty, TakesTheAdapterThatPollsSlowest) {
  drive::Run run = run_of();
  run.seen.transmit_stamps_echoed = true;
  EXPECT_THAT(left_out(stamp_conditions(run)), IsEmpty());
  run.adapters = {{.bus = "local:x", .kind = "virtual"}};
  EXPECT_FALSE(stamp_conditions(run).wire_unknown);
  run.adapters = {{.bus = "can0", .kind = "usb", .usb_mbitps = 480},
                  {.bus = "can1", .kind = "usb", .usb_mbitps = 12}};
  EXPECT_EQ(stamp_conditions(run).usb_poll_s, 1e-3);
  EXPECT_THAT(left_out(stamp_conditions(run)), ElementsAre(HasSubstr("bit rate is not known")));
  run.seen.bit_rates = {.nominal = 500'000};
  run.seen.transmit_stamps_echoed = false;
  EXPECT_EQ(stamp_conditions(run).bit_s, 2e-6);
  EXPECT_THAT(left_out(stamp_conditions(run)), ElementsAre(HasSubstr("echoed nothing")));
  run.adapters.pop_back();
  EXPECT_EQ(stamp_conditions(run).usb_poll_s, 125e-6);
}

// 200 answers with 201 to 400 us in steps of 1 us: p50 is 300.5 us, the middle of the bucket with the 100th
// answer.
TEST(Uncertainty, IsInTextJsonAndPageAlike) {
  const drive::Run run = run_on_a_wire();
  const auto report = document(scenario_of(), run);
  const auto& p50 = report.at("uncertainty").at("latency_s").at("AlignVelocityD").at("p50");
  EXPECT_NEAR(p50.at("value").get<double>(), 300.5 * us, 1e-12);
  // u^2 = (2 * 0.0005^2 + 0.15025^2 + 30^2 + 2^2 + 0.5^2) / 3, U = 2 u
  EXPECT_NEAR(p50.at("expanded").get<double>(), 34.723144 * us, 1e-11);
  EXPECT_NEAR(p50.at("half_widths").at("host").get<double>(), 30 * us, 1e-12);
  EXPECT_EQ(
      report.at("uncertainty").at("latency_s").at("AlignVelocityD").at("max").at("half_widths").at("figure"),
      0);
  EXPECT_EQ(report.at("uncertainty").at("k"), 2);
  EXPECT_THAT(text(scenario_of(), run),
              HasSubstr("uncertainty AlignVelocityD      p50 ±0.035  p99 ±0.035  max ±0.035 ms  (k = 2)"));
  EXPECT_THAT(html(report).value(),
              HasSubstr("D, p50</td><td align=\"right\" data-label=\"ms\">0.<wbr>301</td>"
                        "<td align=\"right\" data-label=\"U ms\">&plusmn; 0.<wbr>035</td>"));
}

TEST(Uncertainty, IsOnlyOfRealTime) {
  drive::Run run = run_on_a_wire();
  for (const drive::ClockKind clock : {drive::ClockKind::lockstep, drive::ClockKind::simulated_wire}) {
    run.clock = clock;
    EXPECT_FALSE(document(scenario_of(), run).contains("uncertainty"));
    EXPECT_THAT(text(scenario_of(), run), Not(HasSubstr("uncertainty")));
  }
}

}  // namespace
}  // namespace canhil::report
