// How long answers of a kind hold: what estimators' rules of freshness are put together from.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/checks/silence.hpp"
#include "bench/scenario/fix_faults.hpp"
#include "bench/scenario/schedule.hpp"

namespace canhil::estimators {

/// The time between samples of a node [us]. `cycle_us`: of the DBC, where the scenario says nothing.
double period_us(const scenario::Schedule& schedule, std::int64_t cycle_us);

/// The longest time between answers to fixes that is no silence [us]. Fixes may be lost on purpose: those
/// that the scenario loses at random (loss_percent, invalid_percent) make nothing stale; its silences do.
double longest_wait_of_fixes_us(const scenario::Schedule& schedule, std::int64_t cycle_us,
                                const scenario::FixFaults& faults);

}  // namespace canhil::estimators
