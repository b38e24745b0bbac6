// Measures the time of one step of each algorithm, and of the parts of a step.
#include <benchmark/benchmark.h>

#include <memory>

#include "tests/perf/estimators/warm_glider.hpp"

namespace canhil::wind {
namespace {

// Each iteration starts from the same state; the measured time includes the copy of the State.
void glider_step(benchmark::State& bench, Algorithm algorithm, ProcessNoise noise) {
  const auto warm = std::make_unique<WarmGlider>(warm_glider(algorithm, noise));
  for (auto _ : bench) {
    State state = warm->state;
    benchmark::DoNotOptimize(step(state, warm->navigation, warm->fins, warm->design));
    benchmark::DoNotOptimize(state);
  }
}

void copy_glider_state(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmGlider>(warm_glider(Algorithm::ekf));
  for (auto _ : bench) {
    State state = warm->state;
    benchmark::DoNotOptimize(state);
  }
}

void predict_glider(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmGlider>(warm_glider(Algorithm::ekf));
  const Inputs inputs{{}, standard_atmosphere(10'000)};
  for (auto _ : bench) {
    StateVector x = warm->state.x;
    Covariance P = warm->state.P;
    RangeFlags outside;
    predict(x, P, 0.02, inputs, warm->design.settings.density, warm->design, outside);
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(P);
  }
}

void update_glider(benchmark::State& bench, Algorithm algorithm) {
  const auto warm = std::make_unique<WarmGlider>(warm_glider(algorithm));
  const Observation y =
      (Observation() << warm->navigation.v_eb_n, warm->navigation.omega, warm->navigation.attitude)
          .finished();
  for (auto _ : bench) {
    StateVector x = warm->state.x;
    Covariance P = warm->state.P;
    benchmark::DoNotOptimize(update(x, P, y, 0.02, warm->design));
    benchmark::DoNotOptimize(P);
  }
}

void glider_uncertainty(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmGlider>(warm_glider(Algorithm::ekf));
  for (auto _ : bench) benchmark::DoNotOptimize(uncertainty(warm->state));
}

BENCHMARK_CAPTURE(glider_step, ekf, Algorithm::ekf, ProcessNoise::block_diagonal);
BENCHMARK_CAPTURE(glider_step, ekf_correlated, Algorithm::ekf, ProcessNoise::correlated);
BENCHMARK_CAPTURE(glider_step, h_infinity, Algorithm::h_infinity, ProcessNoise::block_diagonal);
BENCHMARK_CAPTURE(glider_step, adaptive_q, Algorithm::adaptive_q, ProcessNoise::block_diagonal);
BENCHMARK(copy_glider_state);
BENCHMARK(predict_glider);
BENCHMARK_CAPTURE(update_glider, ekf, Algorithm::ekf);
BENCHMARK_CAPTURE(update_glider, h_infinity, Algorithm::h_infinity);
BENCHMARK(glider_uncertainty);

}  // namespace
}  // namespace canhil::wind

BENCHMARK_MAIN();
