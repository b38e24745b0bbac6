// Park and Park, wind estimation of a glider without an air-speed sensor (2019), flown over the bus.
#pragma once

#include "bench/papers/flown.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers::wind {

/// Flies what the folder does not hold yet, and makes the page: tables, figures and verdicts; it says so
/// where there are fewer runs than the bars ask. `exact` is not looked at. None: stopped. Error: one line.
Result<std::optional<Reproduction>> reproduce(const FlyOptions& options, const std::filesystem::path& exact,
                                              const std::atomic<bool>& stop);

}  // namespace canhil::papers::wind
