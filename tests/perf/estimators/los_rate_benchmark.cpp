// Measures the time of one step of each algorithm (both planes, with roll), the time of the parts in which
// the algorithms differ, and the time of the start-up.
#include <benchmark/benchmark.h>

#include <memory>

#include "tests/perf/estimators/warm_seeker.hpp"

namespace canhil::los_rate {
namespace {

// Each iteration starts from the same state; the measured time includes the copy of the State.
void seeker_step(benchmark::State& bench, Algorithm algorithm, double range, bool equal) {
  const auto warm = std::make_unique<WarmSeeker>(warm_seeker(algorithm, range, equal));
  for (auto _ : bench) {
    State state = warm->state;
    benchmark::DoNotOptimize(step(state, warm->measurement, warm->design));
    benchmark::DoNotOptimize(state);
  }
}

void copy_seeker_state(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmSeeker>(warm_seeker(Algorithm::kalman));
  for (auto _ : bench) {
    State state = warm->state;
    benchmark::DoNotOptimize(state);
  }
}

// The following functions measure how long each algorithm takes to compute the gain of one plane. The range r
// decreases a little with each call, so that successive calls have different inputs.
Geometry moving(double& r) {
  r = r > 1800 ? r - 1e-3 : 2000;
  return {r, 900};
}
void gain_p_bar(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmSeeker>(warm_seeker(Algorithm::switched_table));
  double r = 2000;
  for (auto _ : bench)
    benchmark::DoNotOptimize(closed_gain(warm->design.p_bar.pitch, warm->design.settings, moving(r)));
}
void gain_combined(benchmark::State& bench) {
  const auto warm = std::make_unique<WarmSeeker>(warm_seeker(Algorithm::combined));
  double r = 2000;
  for (auto _ : bench) benchmark::DoNotOptimize(closed_gain(warm->design.combined.pitch, moving(r)));
}
void gain_kalman(benchmark::State& bench) {
  const Settings settings;
  Covariance P = steady_covariance(settings, settings.noise.pitch, {2000, 900});
  double r = 2000;
  for (auto _ : bench) {
    const Geometry at = moving(r);
    P = predicted(P, at, settings.sample_period, settings.jerk_density);
    const Gain K = kalman_gain(P, sample_variance(settings.noise.pitch, at.range));
    P = updated(P, K);
    benchmark::DoNotOptimize(P);
  }
}
// What the combined gain would cost per sample if it were computed for each sample instead of read from its
// table.
void gain_combined_solved(benchmark::State& bench) {
  const Settings settings;
  double r = 2000;
  for (auto _ : bench) {
    const Geometry at = moving(r);
    const SteadyState steady = steady_state(
        settings.jerk_density, displacement_noise(settings.noise.pitch, at, settings.sample_period));
    benchmark::DoNotOptimize(polar(pole_matched(steady.d, settings.sample_period), at));
  }
}

void start_up(benchmark::State& bench, Algorithm algorithm) {
  Settings settings;
  settings.algorithm = algorithm;
  const auto design = std::make_unique<Design>();
  for (auto _ : bench) {
    *design = make_design(settings);
    benchmark::DoNotOptimize(*design);
  }
}

BENCHMARK_CAPTURE(seeker_step, switched_table_thermal, Algorithm::switched_table, 2000, true);
BENCHMARK_CAPTURE(seeker_step, switched_table_glint, Algorithm::switched_table, 1000, true);
BENCHMARK_CAPTURE(seeker_step, combined, Algorithm::combined, 2000, true);
BENCHMARK_CAPTURE(seeker_step, combined_two_sets, Algorithm::combined, 2000, false);
BENCHMARK_CAPTURE(seeker_step, kalman, Algorithm::kalman, 2000, true);
BENCHMARK_CAPTURE(seeker_step, kalman_two_sets, Algorithm::kalman, 2000, false);
BENCHMARK_CAPTURE(seeker_step, low_pass, Algorithm::low_pass, 2000, true);
BENCHMARK(copy_seeker_state);
BENCHMARK(gain_p_bar);
BENCHMARK(gain_combined);
BENCHMARK(gain_combined_solved);
BENCHMARK(gain_kalman);
BENCHMARK_CAPTURE(start_up, switched_table, Algorithm::switched_table);
BENCHMARK_CAPTURE(start_up, combined, Algorithm::combined);

}  // namespace
}  // namespace canhil::los_rate

BENCHMARK_MAIN();
