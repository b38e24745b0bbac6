// Measures the runs per second of the campaign engine with one thread and with two, including the time to
// store results. Measurements with one and with two threads alternate, so that other load of the machine
// affects both equally.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <thread>
#include <vector>

#include "bench/campaign/execute.hpp"
#include "tests/perf/run/paper_flight.hpp"

namespace {

using namespace canhil;

constexpr int repeats = 7;
constexpr std::uint64_t runs = 800;  // runs per variant; in one thread they take about four seconds

struct Rate {
  double runs_per_s = 0;
  // CPU time of a run. It shows how much the threads slow each other down, and is independent of other load.
  double processor_ms = 0;
};

Rate measured(const campaign::Campaign& campaign, unsigned threads) {
  static const std::atomic<bool> never = false;
  const auto file =
      std::filesystem::temp_directory_path() / ("canhil-run-threads-" + std::to_string(getpid()) + ".sqlite");
  std::filesystem::remove(file);
  campaign::Options options;
  options.file = file;
  options.threads = threads;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  const auto done = campaign::execute(campaign, options, never);
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double processor_s = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  std::filesystem::remove(file);
  if (!done) {
    std::fprintf(stderr, "run_threads: %s\n", done.error().message.c_str());
    std::exit(1);
  }
  const auto flown = static_cast<double>(campaign.variants.size() * campaign.runs);
  return {.runs_per_s = flown / s, .processor_ms = 1e3 * processor_s / flown};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

int main() {
  campaign::Campaign campaign = paper_campaign();
  campaign.runs = runs;
  std::erase_if(campaign.variants,
                [](const auto& v) { return v.name != "kf_p1" && v.name != "h2_case2_p1"; });
  campaign.metrics.clear();
  double load = 0;
  getloadavg(&load, 1);
  std::printf("load of the machine before: %.1f on %u cores%s\n", load, std::thread::hardware_concurrency(),
              load > 0.3 ? "; it is not free, so the ratio says little" : "");
  std::vector<double> one, two, ratio, cost;
  for (int i = 0; i < repeats; ++i) {
    std::array<Rate, 2> rate{};
    for (const int which : {i % 2, 1 - i % 2})  // 0: one thread, 1: two threads; in changing order
      rate[static_cast<std::size_t>(which)] = measured(campaign, static_cast<unsigned>(which + 1));
    one.push_back(rate[0].runs_per_s);
    two.push_back(rate[1].runs_per_s);
    ratio.push_back(two.back() / one.back());
    cost.push_back(rate[1].processor_ms / rate[0].processor_ms);
    std::printf("  one thread %4.0f runs/s, %.2f ms of processor a run; two %4.0f, %.2f ms; ratio %.2f\n",
                one.back(), rate[0].processor_ms, two.back(), rate[1].processor_ms, ratio.back());
  }
  std::printf(
      "medians of %d: %.0f runs/s in one thread, %.0f in two; processor time a run in two: %.2f of that in "
      "one\n",
      repeats, median(one), median(two), median(cost));
  std::printf("two threads : one thread  %.2f  (goal: at least 1.9: %s)\n", median(ratio),
              median(ratio) >= 1.9 ? "met" : "not met");
}
