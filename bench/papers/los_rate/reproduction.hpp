// Na, Lee, "A Practical Real-Time LOS Rate Estimator with Time-Varying Measurement Noise Variance", flown
// over the bus.
#pragma once

#include "bench/papers/flown.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers::los_rate {

/// Flies what the folder does not hold yet, and makes the page: figures, tables and verdicts; it says so
/// where there are fewer runs than the bars ask. `exact` is not looked at. None: stopped. Error:
/// one line.
Result<std::optional<Reproduction>> reproduce(const FlyOptions& options, const std::filesystem::path& exact,
                                              const std::atomic<bool>& stop);

}  // namespace canhil::papers::los_rate
