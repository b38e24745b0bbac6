// The answers of the reference target in one flight, with the allowed deviation of a target.
//
// Two correct targets differ by rounding: each signal is rounded to its step in the DBC, and the rounded
// inputs of the filter change its estimates. A second flight of the reference target, with unrounded frames,
// measures this effect. A target may deviate from the reference by at most these limits, each
// multiplied by `share`:
//   at an instant:  2 steps + 4 times the largest effect of rounding over the flight
//   in the mean:    1/4 step + 4 times the effect of rounding on the mean
// Flags, states and counts must be equal at each instant, unless rounding changes them. The mean of a flag,
// state or count may differ by the contribution of one answer.
#pragma once

#include <string>
#include <vector>

#include "bench/accept/profile.hpp"

namespace canhil::accept {

/// The reference of one message.
struct ReferenceMessage {
  std::string name;
  std::size_t count = 0;
  std::vector<std::string> signals{};
  std::vector<double> rounding{}, mean{}, mean_rounding{};  ///< one number per signal
  struct Row {
    std::size_t index = 0;  ///< position of this answer among the answers of the message
    double t_s = 0;
    std::vector<double> values;
  };
  std::vector<Row> rows{};
};
using Reference = std::vector<ReferenceMessage>;

/// `rows`: number of instants kept per message, evenly spaced over the answers of the message. `unrounded`:
/// answers of the same flight with unrounded frames.
Reference make_reference(const Answers& answers, const Answers& unrounded, std::size_t rows);

/// Describes where a target deviates too far from the reference: names the signal with the largest ratio of
/// deviation to tolerance, and the first time of that deviation. Empty if no deviation is larger than its
/// tolerance.
std::string departure(const Reference& reference, const Answers& answers, double share = 1);

/// Describes where two flights of one target differ although they must agree. A value may deviate by `steps`
/// steps of its signal plus `relative` times the value in `other`. Compares all messages in `one` except
/// heartbeats, because a heartbeat names the algorithm.
std::string difference(const Answers& one, const Answers& other, double steps, double relative);

}  // namespace canhil::accept
