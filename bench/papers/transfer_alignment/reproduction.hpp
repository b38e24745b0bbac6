// Yang, Shim, Park, "Velocity Matching Algorithm Using Robust H2 Filter" (2001), flown over the bus.
#pragma once

#include "bench/papers/page.hpp"
#include "bench/papers/transfer_alignment/results.hpp"

namespace canhil::papers::transfer_alignment {

/// The page on the results: figures, tables and verdicts. Says so where there are fewer runs than the bars
/// ask.
Page page(const Results& results);

}  // namespace canhil::papers::transfer_alignment
