// A program for callgrind. Each measured call is in a function of its own, which is called once; callgrind
// counts the instructions of this function.
#include <cstdio>
#include <memory>

#include "tests/perf/estimators/warm_seeker.hpp"

using namespace canhil::los_rate;

#define MEASURED extern "C" [[gnu::noinline]]

MEASURED UpdateResult step_switched_thermal(WarmSeeker& s) { return step(s.state, s.measurement, s.design); }
MEASURED UpdateResult step_switched_glint(WarmSeeker& s) { return step(s.state, s.measurement, s.design); }
MEASURED UpdateResult step_combined(WarmSeeker& s) { return step(s.state, s.measurement, s.design); }
MEASURED UpdateResult step_kalman(WarmSeeker& s) { return step(s.state, s.measurement, s.design); }
MEASURED UpdateResult step_low_pass(WarmSeeker& s) { return step(s.state, s.measurement, s.design); }

namespace {
std::unique_ptr<WarmSeeker> warm(Algorithm algorithm, double range = 2000) {
  return std::make_unique<WarmSeeker>(warm_seeker(algorithm, range));
}
}  // namespace

int main() {
  const auto thermal = warm(Algorithm::switched_table), glint = warm(Algorithm::switched_table, 1000);
  const auto combined = warm(Algorithm::combined), kalman = warm(Algorithm::kalman);
  const auto low_pass = warm(Algorithm::low_pass);
  const double nis = step_switched_thermal(*thermal).nis + step_switched_glint(*glint).nis +
                     step_combined(*combined).nis + step_kalman(*kalman).nis + step_low_pass(*low_pass).nis;
  std::printf("NIS %g\n", nis);
  return 0;
}
