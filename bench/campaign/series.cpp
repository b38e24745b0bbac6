#include "bench/campaign/series.hpp"

namespace canhil::campaign {

RunSeries series_of(std::uint64_t run_index, const run::Collected& finished, const world::FlightRecord& truth,
                    const estimators::Estimator& estimator) {
  const auto& [engagement, glide] = finished.own_truth;
  const estimators::Truth all{
      .flight = truth, .engagement = engagement ? &*engagement : nullptr, .glide = glide ? &*glide : nullptr};
  return {.run = run_index, .ending = finished.ending, .samples = estimator.samples(finished.seen, all)};
}

}  // namespace canhil::campaign
