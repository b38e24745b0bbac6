// A program for callgrind. Each measured call is in a function of its own, which is called once; callgrind
// counts the instructions of this function.
#include <cstdio>
#include <memory>

#include "target/estimators/wind/bank.hpp"
#include "tests/perf/estimators/warm_glider.hpp"

using namespace canhil::wind;

#define MEASURED extern "C" [[gnu::noinline]]

// The recommended filter is a bank of filters. Each filter of the bank begins with the state that a single
// filter has after five seconds.
struct WarmBank {
  WarmGlider glider;
  BankDesign design = make_bank({});
  Bank bank = initial(design);
};

MEASURED UpdateResult step_ekf(WarmGlider& g) { return step(g.state, g.navigation, g.fins, g.design); }
MEASURED UpdateResult step_h_infinity(WarmGlider& g) { return step(g.state, g.navigation, g.fins, g.design); }
MEASURED UpdateResult step_adaptive_q(WarmGlider& g) { return step(g.state, g.navigation, g.fins, g.design); }

MEASURED UpdateResult step_recommended(WarmBank& b) {
  return step(b.bank, b.glider.navigation, b.glider.fins, b.design);
}

namespace {
std::unique_ptr<WarmGlider> warm(Algorithm algorithm) {
  return std::make_unique<WarmGlider>(warm_glider(algorithm));
}
}  // namespace

int main() {
  const auto ekf = warm(Algorithm::ekf), h_infinity = warm(Algorithm::h_infinity);
  const auto adaptive_q = warm(Algorithm::adaptive_q);
  WarmBank recommended{warm_glider(Algorithm::adaptive_q, ProcessNoise::likeliest)};
  for (State& state : recommended.bank.states) state = recommended.glider.state;
  const double nis = step_recommended(recommended).nis + step_ekf(*ekf).nis +
                     step_h_infinity(*h_infinity).nis + step_adaptive_q(*adaptive_q).nis;
  std::printf("NIS %g\n", nis);
  return 0;
}
