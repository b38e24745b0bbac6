// How long answers of a kind hold: what estimators' rules of freshness are put together from.
#pragma once

#include "bench/checks/silence.hpp"
#include "bench/scenario/node.hpp"

namespace canhil::estimators {

/// The time between samples of a node [us].
double period_us(const scenario::NodeSettings& node);

/// The longest time between answers to fixes that is no silence [us]. Fixes may be lost on purpose: those
/// that the scenario loses at random (loss_percent, invalid_percent) make nothing stale; its silences do.
double longest_wait_of_fixes_us(const scenario::NodeSettings& aid);

}  // namespace canhil::estimators
