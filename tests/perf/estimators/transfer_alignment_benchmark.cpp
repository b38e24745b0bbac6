// Measures the time of one IMU step, of one velocity update, of both together, and of the covariance
// prediction alone.
#include <benchmark/benchmark.h>

#include "target/estimators/filtering/block_transition.hpp"
#include "target/estimators/transfer_alignment/history.hpp"
#include "tests/perf/estimators/warm_filter.hpp"

namespace canhil::transfer_alignment {
namespace {

using strapdown::Mechanization;

void imu_step(benchmark::State& bench, Mechanization mechanization) {
  const WarmFilter warm = warm_filter(Algorithm::kalman, mechanization);
  State state = warm.state;
  for (auto _ : bench) {
    propagate(state, warm.imu, warm.settings);
    benchmark::DoNotOptimize(state.ins);
  }
}

// Each iteration starts from the same state; the measured time includes the copy of the State.
void velocity_update(benchmark::State& bench, Algorithm algorithm) {
  const WarmFilter warm = warm_filter(algorithm, Mechanization::two_sample);
  for (auto _ : bench) {
    State state = warm.state;
    benchmark::DoNotOptimize(update(state, warm.master_velocity, warm.settings));
    benchmark::DoNotOptimize(state);
  }
}

void imu_step_and_update(benchmark::State& bench, Algorithm algorithm) {
  const WarmFilter warm = warm_filter(algorithm, Mechanization::two_sample);
  for (auto _ : bench) {
    State state = warm.state;
    propagate(state, warm.imu, warm.settings);
    benchmark::DoNotOptimize(update(state, warm.master_velocity, warm.settings));
    benchmark::DoNotOptimize(state);
  }
}

void copy_state(benchmark::State& bench) {
  const WarmFilter warm = warm_filter(Algorithm::kalman, Mechanization::two_sample);
  for (auto _ : bench) {
    State state = warm.state;
    benchmark::DoNotOptimize(state);
  }
}

void predict_covariance(benchmark::State& bench) {
  const WarmFilter warm = warm_filter(Algorithm::kalman, Mechanization::two_sample);
  const Covariance G = transition_increment(warm.state.ins.interval);
  for (auto _ : bench) {
    benchmark::DoNotOptimize(filtering::propagate_covariance_blocks<h2_blocks, state_count>(warm.state.P, G));
  }
}

// An update with a measurement that arrives 200 ms late. The IMU sends 100 samples per second, so after the
// update the mechanisation processes 20 increments again.
void late_update(benchmark::State& bench) {
  const WarmFilter warm = warm_filter(Algorithm::robust_h2, Mechanization::two_sample);
  History<32> history(0);
  State state = warm.state;
  for (int k = 1; k <= 30; ++k) history.propagate(state, warm.imu, k * 10'000L, warm.settings);
  for (auto _ : bench) {
    State late = state;
    History<32> copy = history;
    benchmark::DoNotOptimize(copy.update(late, warm.master_velocity, 100'000, warm.settings));
  }
}

BENCHMARK_CAPTURE(imu_step, reference, Mechanization::reference);
BENCHMARK_CAPTURE(imu_step, two_sample, Mechanization::two_sample);
BENCHMARK_CAPTURE(velocity_update, kalman, Algorithm::kalman);
BENCHMARK_CAPTURE(velocity_update, robust_h2, Algorithm::robust_h2);
BENCHMARK_CAPTURE(imu_step_and_update, kalman, Algorithm::kalman);
BENCHMARK_CAPTURE(imu_step_and_update, robust_h2, Algorithm::robust_h2);
BENCHMARK(predict_covariance);
BENCHMARK(copy_state);
BENCHMARK(late_update);

}  // namespace
}  // namespace canhil::transfer_alignment

BENCHMARK_MAIN();
