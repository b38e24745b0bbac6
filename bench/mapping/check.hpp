// What a mapping leaves out, and what its signals cannot carry: before the first run.
#pragma once

#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "dbc/wire/bit_length.hpp"

namespace canhil::mapping {

struct Remark {
  /// What there is to be known, or what is to be mended.
  enum class Grade : std::uint8_t { note, warning };
  Grade grade = Grade::note;
  std::string rule;     ///< "saturates"
  std::string subject;  ///< "IMU_TX1.TX1_YawRate"
  std::string what;     ///< one line
};

/// In the order of plays and hears: signals that nothing is put into, or nothing is read of; ranges and steps
/// beside what the node may send and the noise of its sensor (the project's DBC: limits, SensorSigma); cycle
/// times beside the DBC's; messages of the target's senders that nobody hears.
std::vector<Remark> remarks_on(const Mapping& mapping);

/// The share of a bus that the messages of the mapping take, by their longest frames; those without a cycle
/// time are left out.
double load_of(const Mapping& mapping, const wire::BitRates& rates);

}  // namespace canhil::mapping
