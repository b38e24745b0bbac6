// Computes the series of one run of a campaign: the samples of the quantities that the estimator reports. The
// computation uses only the decoded frames and the truth.
#pragma once

#include <cstdint>

#include "bench/drive/session.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/quantities/list.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::campaign {

using quantities::Quantity;

/// One run of one variant.
struct RunSeries {
  std::uint64_t run = 0;
  drive::Ending ending;  ///< a run that was not completed keeps its samples
  quantities::Samples samples{};
  quantities::Freshness freshness{};
  std::string judged{};  ///< what was judged in the run, as JSON (judged.hpp); empty: nothing
};

/// The samples of a finished run. `truth` is the truth of the run's variant, `estimator` the estimator of its
/// scenario. If the truth is unknown, there are no samples.
quantities::Samples samples_of(const checks::Observations& seen, const drive::PerRunTruth& per_run_truth,
                               const world::FlightRecord& truth, const estimators::Estimator& estimator);

}  // namespace canhil::campaign
