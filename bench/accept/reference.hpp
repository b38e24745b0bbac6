// The answers of the reference target in one flight, stored as text, with the allowed deviation of a target.
//
// Two correct targets differ by rounding: each signal is rounded to its step in the DBC, and the filter
// propagates the rounded inputs into its estimates. A second flight, with unrounded frames, measures this
// effect when the reference is made. The deviation of a target may be at most `share` times
//   at an instant:  2 steps + 4 times the largest effect of rounding over the flight
//   in the mean:    1/4 step + 4 times the effect of rounding on the mean
// Flags, states and counts must be equal at an instant, unless rounding changes them; their mean may
// differ by what one answer contributes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/accept/profile.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::accept {

/// The reference of one message.
struct ReferenceMessage {
  std::string name;
  std::size_t count = 0;
  std::vector<std::string> signals{};
  std::vector<double> rounding{}, mean{}, mean_rounding{};  ///< one number per signal
  struct Row {
    std::size_t index = 0;  ///< among the answers of this message
    double t_s = 0;
    std::vector<double> values;
  };
  std::vector<Row> rows{};
};
using Reference = std::vector<ReferenceMessage>;

/// `rows`: number of instants kept per message, evenly spaced over its answers. `unrounded`: the same flight
/// with unrounded frames.
Reference make_reference(const Answers& answers, const Answers& unrounded, std::size_t rows);

/// `comment`: lines at the beginning of the file.
Result<void> write(const Reference& reference, const std::filesystem::path& file, const std::string& comment);
/// Error: one line, with the line of the file.
Result<Reference> read_reference(const std::filesystem::path& file);

/// Where a target deviates from the reference: the signal with the largest deviation, in tolerances, and the
/// first time of that deviation; empty: nowhere.
std::string departure(const Reference& reference, const Answers& answers, double share = 1);

/// The same for two flights of one target that must agree. A value may deviate by `steps` steps of its signal
/// plus `relative` times the value in `other`. Compares the messages in `one`, except heartbeats, which name
/// the algorithm.
std::string difference(const Answers& one, const Answers& other, double steps, double relative);

}  // namespace canhil::accept
