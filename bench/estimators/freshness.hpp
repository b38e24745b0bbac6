// How long answers stay valid: building blocks for the estimators' freshness rules.
#pragma once

#include "bench/checks/silence.hpp"
#include "bench/scenario/node.hpp"

namespace canhil::estimators {

/// The time between samples of a node [us].
double period_us(const scenario::NodeSettings& node);

/// How long [us] the target may send no answer to a fix before this counts as silence. This time allows for
/// the random losses of the scenario (loss_percent, invalid_percent), but not for an interval in which the
/// scenario withholds all fixes (silence_s).
double longest_wait_of_fixes_us(const scenario::NodeSettings& aid);

}  // namespace canhil::estimators
