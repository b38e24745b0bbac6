#include "bench/report/compare.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/unit/bench/report/drawn_latencies.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json distribution(const std::vector<int>& sample_us) {
  std::vector<int> sorted = sample_us;
  std::ranges::sort(sorted);
  const auto at = [&](double q) {
    if (sorted.empty()) return 0.0;
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))] * 1e-6;
  };
  Json json{{"count", sorted.size()},
            {"p50", at(0.5)},
            {"p99", at(0.99)},
            {"closes_group", true},
            {"buckets_us", Json::array()}};
  for (const auto& bucket : buckets_of(sample_us))
    json["buckets_us"].push_back(Json::array({bucket.from_us, bucket.count}));
  return json;
}

Json report_of(const std::vector<int>& sample_us) {
  return {{"verdict", "pass"},
          {"reason", "1 checks passed"},
          {"provenance", {{"scenario_hash", "1"}, {"contract", "classic"}, {"clock", "real time"}}},
          {"checks",
           Json::array({{{"name", "x"}, {"kind", "latency"}, {"outcome", "pass"}, {"measured", "5 ms"}}})},
          {"timing", {{"judged", true}, {"why_not", ""}}},
          {"latency_s", {{"LosRateTarget", distribution(sample_us)}}}};
}

Compared compared(const Json& a, const Json& b) { return compare({a}, {b}).value(); }
Compared compared(const Reports& a, const Reports& b) { return compare(a, b).value(); }

// Runs of one target on one host: the median differs slightly from run to run.
Reports runs_about(const std::vector<double>& medians_us, unsigned seed) {
  Reports runs;
  for (const double median_us : medians_us) runs.push_back(report_of(latencies_us(seed++, median_us)));
  return runs;
}

TEST(Compare, TwoRunsOfTheSameAreNoWorse) {
  const Compared result = compared(report_of(latencies_us(1, 200)), report_of(latencies_us(2, 200)));
  EXPECT_EQ(result.outcome, Comparison::no_worse) << result.text;
}

TEST(Compare, AMedianThatMovesIsWorseOneWayOnly) {
  const Json fast = report_of(latencies_us(1, 200)), slow = report_of(latencies_us(2, 420));
  EXPECT_EQ(compared(fast, slow).outcome, Comparison::worse);
  EXPECT_THAT(compared(fast, slow).text, HasSubstr("worse    latency of LosRateTarget: p50"));
  EXPECT_EQ(compared(slow, fast).outcome, Comparison::no_worse);
}

// Eight runs of the same target on one host: p50 from 58 to 64 us.
TEST(Compare, RunsOfTheSameThatScatterAreNoWorse) {
  const Reports runs = runs_about({58, 64, 60, 59, 63, 61, 62, 58.5}, 1);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t j = 0; j < runs.size(); ++j)
      EXPECT_EQ(compared(runs[i], runs[j]).outcome, Comparison::no_worse) << i << " " << j;
  }
  EXPECT_EQ(compared(Reports(runs.begin(), runs.begin() + 4), Reports(runs.begin() + 4, runs.end())).outcome,
            Comparison::no_worse);
}

TEST(Compare, OneRunASideSaysWhatDifferenceCounts) {
  const Json one = report_of(latencies_us(1, 60));
  EXPECT_THAT(compared(one, one).text,
              HasSubstr("one run a side: counts as worse only if p50 or p99 grew by more than 100 %"));
}

TEST(Compare, SeveralRunsASideShowADifferenceBeyondTheirScatter) {
  const Reports fast = runs_about({58, 64, 60, 61}, 1), slow = runs_about({78, 82, 79, 84}, 11);
  EXPECT_EQ(compared(fast, slow).outcome, Comparison::worse) << compared(fast, slow).text;
  EXPECT_THAT(compared(fast, slow).text, HasSubstr("worse    latency of LosRateTarget: p50 5"));
  EXPECT_EQ(compared(slow, fast).outcome, Comparison::no_worse);
}

TEST(Compare, ACheckThatFailsInOneOfSeveralRunsIsWorseIfItDidInNone) {
  const Reports good = runs_about({60, 60, 60}, 1);
  Reports one_bad = good;
  one_bad[1]["checks"][0]["outcome"] = "fail";
  EXPECT_EQ(compared(good, one_bad).outcome, Comparison::worse);
  EXPECT_THAT(compared(good, one_bad).text, HasSubstr("check 'x': pass -> 2 pass, 1 fail"));
  EXPECT_EQ(compared(one_bad, one_bad).outcome, Comparison::no_worse);
  Reports all_bad = one_bad;
  for (Json& run : all_bad) run["checks"][0]["outcome"] = "fail";
  EXPECT_EQ(compared(one_bad, all_bad).outcome, Comparison::worse);
}

TEST(Compare, ATailThatGrowsIsWorseThoughTheMedianStays) {
  const Json light = report_of(latencies_us(1, 200)), heavy = report_of(latencies_us(2, 200, 2000, 0.04));
  const Compared result = compared(light, heavy);
  EXPECT_EQ(result.outcome, Comparison::worse) << result.text;
  EXPECT_EQ(compared(heavy, light).outcome, Comparison::no_worse);
}

// On a busy host the bench itself is late, and so is a target.
TEST(Compare, ATailThatTheHostExplainsIsUnknown) {
  const Json light = report_of(latencies_us(1, 200));
  Json heavy = report_of(latencies_us(2, 200, 2000, 0.04));
  heavy["bench_lateness_s"] = {{"p50", 20e-6}, {"p99", 250e-6}};  // more than half of 800 - 250 us
  EXPECT_EQ(compared(light, heavy).outcome, Comparison::worse) << compared(light, heavy).text;
  heavy["bench_lateness_s"]["p99"] = 900e-6;
  EXPECT_EQ(compared(light, heavy).outcome, Comparison::not_comparable);
  EXPECT_THAT(compared(light, heavy).text,
              HasSubstr("; the host kept the bench itself late by 20 us (p50), 900 us (p99)\n"));
  const Json slow = report_of(latencies_us(2, 420));
  EXPECT_EQ(compared(light, slow).outcome, Comparison::worse) << "a quiet host explains nothing";
}

TEST(Compare, ADifferenceThatIsSureButSmallIsNotWorse) {
  const Compared result =
      compared(report_of(latencies_us(1, 200, 50'000)), report_of(latencies_us(2, 202, 50'000)));
  EXPECT_EQ(result.outcome, Comparison::no_worse) << result.text;
}

TEST(Compare, AFewSamplesProveNothing) {
  const Compared result = compared(report_of(latencies_us(1, 200, 3)), report_of(latencies_us(2, 300, 3)));
  EXPECT_EQ(result.outcome, Comparison::no_worse) << result.text;
}

TEST(Compare, AMessageThatIsAnsweredNoMoreIsWorse) {
  Json silent = report_of(latencies_us(2, 200));
  silent.erase("latency_s");
  EXPECT_EQ(compared(report_of(latencies_us(1, 200)), silent).outcome, Comparison::worse);
  const Json never = report_of({});
  EXPECT_THAT(compared(report_of(latencies_us(1, 200)), never).text, HasSubstr("no answers any more"));
  EXPECT_NE(compared(never, never).outcome, Comparison::worse) << "nothing got worse";
}

TEST(Compare, ACheckThatFailsNowIsWorse) {
  const Json good = report_of(latencies_us(1, 200));
  Json bad = good;
  bad["checks"][0]["outcome"] = "fail";
  const Compared result = compared(good, bad);
  EXPECT_EQ(result.outcome, Comparison::worse);
  EXPECT_THAT(result.text, HasSubstr("worse    check 'x': pass -> fail (5 ms)"));
  EXPECT_EQ(compared(bad, good).outcome, Comparison::no_worse);
  EXPECT_EQ(compared(bad, bad).outcome, Comparison::no_worse);
}

// Adds the implied check bus_errors. If the scenario does not have this check, a report contains it only if
// the bus failed.
Json with_bus_errors(Json report) {
  report["checks"].push_back(
      {{"name", "bus_errors"}, {"kind", "bus_errors"}, {"outcome", "fail"}, {"measured", "bus off 1"}});
  return report;
}

TEST(Compare, AnImpliedCheckThatAppearsIsWorse) {
  const Json good = report_of(latencies_us(1, 200));
  const Json bad = with_bus_errors(good);
  EXPECT_EQ(compared(good, bad).outcome, Comparison::worse);
}

TEST(Compare, ACheckThatIsGoneIsNotNoWorse) {
  const Json whole = report_of(latencies_us(1, 200));
  Json without = whole;
  without["checks"] = Json::array();
  EXPECT_EQ(compared(whole, without).outcome, Comparison::not_comparable);
  EXPECT_THAT(compared(whole, without).text, HasSubstr("unknown  check 'x': pass -> not there"));
  EXPECT_EQ(compared(without, whole).outcome, Comparison::not_comparable);
}

TEST(Compare, TheImpliedChecksMayBeGone) {
  const Json good = report_of(latencies_us(1, 200));
  EXPECT_EQ(compared(with_bus_errors(good), good).outcome, Comparison::no_worse);
  Json crowded = good;
  crowded["checks"].push_back(
      {{"name", "senders"}, {"kind", "senders"}, {"outcome", "fail"}, {"measured", "Sync 1"}});
  EXPECT_EQ(compared(crowded, good).outcome, Comparison::no_worse);
}

TEST(Compare, AnOutcomeThatIsNoneIsAnError) {
  const Json good = report_of(latencies_us(1, 200));
  Json odd = good;
  odd["checks"][0]["outcome"] = "perhaps";
  const auto result = compare({good}, {odd});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message,
            "outcome 'perhaps' of check 'x', expected 'pass', 'fail' or 'not measured'");
  odd = good;
  odd["verdict"] = "perhaps";
  EXPECT_FALSE(compare({good}, {odd}));
}

TEST(Compare, ARunThatEndedEarlyIsWorse) {
  const Json good = report_of(latencies_us(1, 200));
  Json bad = good;
  bad["verdict"] = "fail";
  bad["reason"] = "target silent";
  EXPECT_EQ(compared(good, bad).outcome, Comparison::worse);
}

TEST(Compare, AnotherScenarioOrClockIsNotComparable) {
  const Json one = report_of(latencies_us(1, 200));
  Json other = one;
  other["provenance"]["scenario_hash"] = "2";
  EXPECT_EQ(compared(one, other).outcome, Comparison::not_comparable);
  other = one;
  other["provenance"]["contract"] = "fd";
  EXPECT_EQ(compared(one, other).outcome, Comparison::not_comparable);
  other = one;
  other["provenance"]["clock"] = "lockstep";
  EXPECT_EQ(compared(one, other).outcome, Comparison::not_comparable);
}

TEST(Compare, SaysInWhatElseTheRunsDiffer) {
  const Json one = report_of(latencies_us(1, 200));
  EXPECT_THAT(compared(one, one).text, Not(HasSubstr("differs")));
  Json other = one;
  other["provenance"].update({{"seed", 8}, {"revision", "b"}, {"cpu_model", "Slow"}, {"dbc_hash", "2"}});
  Json first = one;
  first["provenance"].update({{"seed", 7}, {"revision", "a"}, {"cpu_model", "Slow"}, {"dbc_hash", "1"}});
  const Compared result = compared(first, other);
  EXPECT_EQ(result.outcome, Comparison::no_worse);
  EXPECT_THAT(result.text, HasSubstr("differs  seed: 7 -> 8\ndiffers  revision: a -> b\n"
                                     "differs  DBC: 1 -> 2\n"));
}

TEST(Compare, NamesAnotherBusWireAndHost) {
  Json one = report_of(latencies_us(1, 200));
  one["provenance"].update({{"bus", "can0"}, {"host", "bench-1"}});
  one["wire"]["bitrate_bitps"] = 500000;
  Json other = one;
  other["provenance"].update({{"bus", "can1"}, {"host", "bench-2"}});
  other["wire"]["bitrate_bitps"] = 1000000;
  EXPECT_THAT(compared(one, other).text,
              HasSubstr("differs  bus: can0 -> can1\ndiffers  host: bench-1 -> bench-2\n"
                        "differs  bit rate of the wire: 500000 -> 1000000\n"));
  other = one;
  one["wire"]["data_bitrate_bitps"] = 2000000;
  other["wire"]["data_bitrate_bitps"] = 5000000;
  EXPECT_THAT(compared(one, other).text,
              HasSubstr("differs  data bit rate of the wire: 2000000 -> 5000000\n"));
}

TEST(Compare, NamesAnotherAdapterProgramAndOption) {
  Json one = report_of(latencies_us(1, 200));
  one["provenance"].update(
      {{"adapters", {{{"bus", "can0"}, {"kind", "usb"}, {"serial", "1"}}}},
       {"files",
        {{{"role", "bench"}, {"name", "/a/hil-bench"}, {"sha256", "0123456789abcdef"}, {"date", "x"}},
         {{"role", "target"}, {"name", "/a/hil-target"}, {"sha256", "same"}, {"date", "x"}}}},
       {"target", {{"program", "hil-target"}, {"version", "0.1"}}},
       {"bench_process", {{"policy", "SCHED_OTHER"}, {"spin_us", 0}, {"locked_kib", 0}}}});
  Json other = one;
  EXPECT_THAT(compared(one, other).text, Not(HasSubstr("differs")));
  Json& changed = other["provenance"];
  changed["adapters"][0]["serial"] = "2";
  changed["adapters"].push_back({{"bus", "can1"}, {"kind", "pci"}});
  changed["files"][0].update({{"name", "/b/hil-bench"}, {"sha256", "f123456789abcdef"}, {"date", "y"}});
  changed["files"][1].update({{"name", "/b/hil-target"}, {"date", "y"}});
  changed["files"].push_back({{"role", "faults"}, {"sha256", "77"}});
  changed["target"]["version"] = "0.2";
  changed["bench_process"].update({{"policy", "SCHED_FIFO"}, {"spin_us", 100}, {"locked_kib", 77}});
  changed["operator"] = "Ada";
  EXPECT_THAT(compared(one, other).text,
              testing::StartsWith("differs  adapter: usb -> usb, pci\n"
                                  "differs  serial number of the adapter: 1 -> 2\n"
                                  "differs  program of the bench (SHA-256): 0123456789ab -> f123456789ab\n"
                                  "differs  version of the target: 0.1 -> 0.2\n"
                                  "differs  scheduling: SCHED_OTHER -> SCHED_FIFO\n"
                                  "differs  spin [us]: 0 -> 100\n"
                                  "differs  locked memory: no -> yes\n"
                                  "differs  file of faults (SHA-256): not known -> 77\n"
                                  "differs  operator: not known -> Ada\n"
                                  "latency  one run a side"))
      << "all of them, before the first figure";
}

// A key that a later version adds is reported by name.
TEST(Compare, NamesWhatItDoesNotKnow) {
  Json one = report_of(latencies_us(1, 200)), other = one;
  one["provenance"]["moon"] = "new";
  other["provenance"]["moon"] = "full";
  const Json third = one;
  EXPECT_THAT(compare({one, other}, {third})->text, HasSubstr("differs  moon: new and full -> new\n"));
}

TEST(Compare, TheBusThatABenchMadeForItselfIsNoOther) {
  Json one = report_of(latencies_us(1, 200)), other = one;
  one["provenance"]["bus"] = "local:canhil-123";
  other["provenance"]["bus"] = "local:canhil-4567";
  EXPECT_THAT(compared(one, other).text, Not(HasSubstr("differs")));
}

TEST(Compare, ACheckThatWasNotMeasuredIsNeverNoWorse) {
  const Json good = report_of(latencies_us(1, 200));
  Json unfit = good;
  unfit["checks"][0]["outcome"] = "not measured";
  EXPECT_EQ(compared(good, unfit).outcome, Comparison::not_comparable);
  EXPECT_EQ(compared(unfit, good).outcome, Comparison::not_comparable);
  EXPECT_EQ(compared(unfit, unfit).outcome, Comparison::not_comparable);
  unfit["provenance"]["clock"] = "lockstep";
  EXPECT_EQ(compared(unfit, unfit).outcome, Comparison::no_worse);
}

TEST(Compare, TimingThatWasNotMeasuredIsNeverNoWorse) {
  const Json good = report_of(latencies_us(1, 200));
  Json unfit = good;
  unfit["timing"] = {{"judged", false}, {"why_not", "the bench's port lost 3 frames"}};
  EXPECT_EQ(compared(good, unfit).outcome, Comparison::not_comparable);
  EXPECT_EQ(compared(unfit, good).outcome, Comparison::not_comparable);
  EXPECT_THAT(compared(good, unfit).text, HasSubstr("in the second run the bench's port lost 3 frames"));
  unfit["checks"][0]["outcome"] = "fail";
  EXPECT_EQ(compared(good, unfit).outcome, Comparison::worse);
}

TEST(Compare, AReportThatLacksSomethingIsAnError) {
  Json torn = report_of({1, 2});
  torn.erase("timing");
  const auto result = compare({report_of({1, 2})}, {torn});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("timing"));
}

}  // namespace
}  // namespace canhil::report
