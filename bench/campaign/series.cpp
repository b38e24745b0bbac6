#include "bench/campaign/series.hpp"

namespace canhil::campaign {

quantities::Samples samples_of(const checks::Observations& seen, const drive::PerRunTruth& per_run_truth,
                               const world::FlightRecord& truth, const estimators::Estimator& estimator) {
  return estimator.samples(seen, drive::truth_of(truth, per_run_truth, truth.end_us()));
}

}  // namespace canhil::campaign
