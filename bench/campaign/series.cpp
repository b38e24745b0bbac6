#include "bench/campaign/series.hpp"

namespace canhil::campaign {

RunSeries series_of(std::uint64_t run_index, const drive::Collected& finished,
                    const world::FlightRecord& truth, const estimators::Estimator& estimator) {
  return {.run = run_index,
          .ending = finished.ending,
          .samples = estimator.samples(finished.seen,
                                       drive::truth_of(truth, finished.per_run_truth, truth.end_us()))};
}

}  // namespace canhil::campaign
