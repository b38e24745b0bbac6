// Measures the time of one IMU step, the time of processing one fix, and the time of both together.
// Processing a fix consists of the prediction since the previous fix, and of the update. The prediction is
// also measured alone.
#include <benchmark/benchmark.h>

#include "tests/perf/estimators/warm_inflight_filter.hpp"

namespace canhil::inflight_alignment {
namespace {

void inflight_imu_step(benchmark::State& bench) {
  const WarmInflightFilter warm = warm_inflight_filter(Algorithm::ekf, Aiding::gps);
  State state = warm.state;
  for (auto _ : bench) {
    mechanise(state, warm.imu);
    benchmark::DoNotOptimize(state.ins);
  }
}

// Each iteration starts from the same state; the measured time includes the copy of the State.
void fix_update(benchmark::State& bench, Algorithm algorithm, Aiding aiding) {
  const WarmInflightFilter warm = warm_inflight_filter(algorithm, aiding);
  for (auto _ : bench) {
    State state = warm.state;
    benchmark::DoNotOptimize(update(state, warm.fix, warm.settings));
    benchmark::DoNotOptimize(state);
  }
}

void prediction(benchmark::State& bench, Algorithm algorithm, Aiding aiding) {
  const WarmInflightFilter warm = warm_inflight_filter(algorithm, aiding);
  for (auto _ : bench) {
    State state = warm.state;
    predict(state, warm.settings);
    benchmark::DoNotOptimize(state);
  }
}

void inflight_imu_step_and_update(benchmark::State& bench, Algorithm algorithm, Aiding aiding) {
  const WarmInflightFilter warm = warm_inflight_filter(algorithm, aiding);
  for (auto _ : bench) {
    State state = warm.state;
    propagate(state, warm.imu, warm.settings);
    benchmark::DoNotOptimize(update(state, warm.fix, warm.settings));
    benchmark::DoNotOptimize(state);
  }
}

void copy_inflight_state(benchmark::State& bench) {
  const WarmInflightFilter warm = warm_inflight_filter(Algorithm::ukf, Aiding::ssbl);
  for (auto _ : bench) {
    State state = warm.state;
    benchmark::DoNotOptimize(state);
  }
}

BENCHMARK(inflight_imu_step);
BENCHMARK_CAPTURE(prediction, ekf_15, Algorithm::ekf, Aiding::gps);
BENCHMARK_CAPTURE(prediction, ukf_18, Algorithm::ukf, Aiding::ssbl);
BENCHMARK_CAPTURE(fix_update, ekf_15, Algorithm::ekf, Aiding::gps);
BENCHMARK_CAPTURE(fix_update, ekf_18, Algorithm::ekf, Aiding::ssbl);
BENCHMARK_CAPTURE(fix_update, ukf_15, Algorithm::ukf, Aiding::gps);
BENCHMARK_CAPTURE(fix_update, ukf_18, Algorithm::ukf, Aiding::ssbl);
BENCHMARK_CAPTURE(fix_update, sin_cos_16, Algorithm::sin_cos, Aiding::gps);
BENCHMARK_CAPTURE(fix_update, sin_cos_19, Algorithm::sin_cos, Aiding::ssbl);
BENCHMARK_CAPTURE(inflight_imu_step_and_update, ekf_15, Algorithm::ekf, Aiding::gps);
BENCHMARK(copy_inflight_state);

}  // namespace
}  // namespace canhil::inflight_alignment
