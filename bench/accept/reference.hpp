// What the reference target answered in one flight, kept as text, and how far from it a target may be.
//
// Two right targets differ by rounding: the contract's steps, and what they do to an estimate on its way
// through the filter. The second is measured when the reference is made, by a flight whose frames round
// nothing. A target may be off by `share` times
//   at an instant:  2 steps + 4 times the largest effect of rounding over the flight
//   in the mean:    1/4 step + 4 times the effect of rounding on the mean
// Flags, states and counts may not be off at an instant, unless rounding changes them, and by one answer in
// the mean.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/accept/profile.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::accept {

/// Of one message.
struct ReferenceMessage {
  std::string name;
  std::size_t count = 0;
  std::vector<std::string> signals{};
  std::vector<double> rounding{}, mean{}, mean_rounding{};  ///< a number a signal
  struct Row {
    std::size_t index = 0;  ///< among the answers of this message
    double t_s = 0;
    std::vector<double> values;
  };
  std::vector<Row> rows{};
};
using Reference = std::vector<ReferenceMessage>;

/// `rows`: instants kept of each message, evenly over its answers. `unrounded`: the same flight with frames
/// that round nothing.
Reference make_reference(const Answers& answers, const Answers& unrounded, std::size_t rows);

/// `comment`: lines that say what it is.
Result<void> write(const Reference& reference, const std::filesystem::path& file, const std::string& comment);
/// Error: one line, with the file's.
Result<Reference> read_reference(const std::filesystem::path& file);

/// Where a target left the reference: the first place of the signal that is the most tolerances off, in
/// words; empty: nowhere.
std::string departure(const Reference& reference, const Answers& answers, double share = 1);

/// The same for two flights of one target that are to agree: by `steps` of each signal, and `relative` to
/// the second's value. Messages of both are compared, but for heartbeats, which name the algorithm.
std::string difference(const Answers& one, const Answers& other, double steps, double relative);

}  // namespace canhil::accept
