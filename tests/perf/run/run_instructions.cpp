// Flies the paper's flight under callgrind. stages.py starts this program; callgrind counts the instructions
// of one_run().
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "bench/campaign/series.hpp"
#include "bench/drive/flight.hpp"
#include "tests/perf/run/paper_flight.hpp"

namespace {

using namespace canhil;

// The work of a campaign for one run, except storing the results.
[[gnu::noinline]] std::size_t one_run(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                      std::uint64_t index) {
  const auto finished = drive::run_in_process(scenario, truth, index);
  if (!finished) return 0;
  return campaign::samples_of(finished->seen, finished->per_run_truth, truth, estimators::of(scenario))
      .size();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "kf_p1";
  const campaign::Campaign campaign = paper_campaign();
  for (const campaign::Variant& variant : campaign.variants) {
    if (variant.name != wanted) continue;
    const auto truth = drive::make_truth(variant.scenario);  // a campaign computes the truth once per variant
    if (!truth) break;
    for (std::uint64_t index = 0; index < 3; ++index) {
      if (one_run(variant.scenario, *truth, index) != 199) break;
      if (index == 2) return 0;
    }
  }
  std::fprintf(stderr, "run_instructions: variant %s did not fly as expected\n", argv[1]);
  return 1;
}
