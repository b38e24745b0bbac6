// Yang, Shim, Park, "Velocity Matching Algorithm Using Robust H2 Filter" (2001), flown over the bus.
#pragma once

#include "bench/papers/flown.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers::transfer_alignment {

/// Flies what the folder does not hold yet, and makes the page: figures, tables and verdicts; it says so
/// where there are fewer runs than the bars ask. `exact`: results of table2 by the twin without rounding;
/// empty: none. None: stopped. Error: one line.
Result<std::optional<Reproduction>> reproduce(const FlyOptions& options, const std::filesystem::path& exact,
                                              const std::atomic<bool>& stop);

}  // namespace canhil::papers::transfer_alignment
