// Measures how long the program needs for one run in process, including packing and unpacking of frames. The
// flight lasts 20 s and has an IMU of 100 Hz. A campaign consists of such runs.
#include <benchmark/benchmark.h>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"

namespace canhil {
namespace {

void run_20_s(benchmark::State& state, const char* file) {
  const auto scenario =
      scenario::read_file(std::string(SOURCE_DIR "/bench/flights/") + file, drive::contract());
  if (!scenario) return state.SkipWithError(scenario.error().message.c_str());
  const auto truth = drive::make_truth(*scenario);
  std::uint64_t index = 0;
  for (auto _ : state) {
    auto finished = drive::run_in_process(*scenario, *truth, index++);
    benchmark::DoNotOptimize(finished);
  }
  state.counters["x_real_time"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * 1e-6 * static_cast<double>(scenario->duration_us),
      benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(run_20_s, kalman, "transfer_alignment.toml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run_20_s, robust_h2, "transfer_alignment_h2.toml")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace canhil
