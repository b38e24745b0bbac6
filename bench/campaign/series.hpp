// The series of one run of a campaign, from decoded frames and the truth alone: samples of the quantities
// that its estimator reports.
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
  drive::Ending ending;  ///< a run that did not complete keeps its samples
  quantities::Samples samples{};
  quantities::Freshness freshness{};
};

/// The series of a finished run. `truth` belongs to its variant, `estimator` to its scenario. Without a truth
/// there are no samples.
RunSeries series_of(std::uint64_t run_index, const drive::Collected& finished,
                    const world::FlightRecord& truth, const estimators::Estimator& estimator);

}  // namespace canhil::campaign
