// Checks a mapping before its first run: signals that it leaves out, and values that its signals cannot
// carry.
#pragma once

#include <string>
#include <vector>

#include "bench/mapping/flown.hpp"
#include "dbc/wire/bit_length.hpp"

namespace canhil::mapping {

struct Remark {
  /// A note is for information only. What a warning reports should be corrected.
  enum class Grade : std::uint8_t { note, warning };
  Grade grade = Grade::note;
  std::string rule;     ///< "saturates"
  std::string subject;  ///< "IMU_TX1.TX1_YawRate"
  std::string what;     ///< one line
};

/// Remarks in the order of the plays (messages to the target) and then the hears (messages of the target),
/// about:
/// - signals without a mapped value, or with a value that is not used;
/// - if the values of a flight are given: signals that cannot hold all of them, and signals whose steps are
/// coarse
///   compared with the noise;
/// - periods that differ from the DBC's cycle times;
/// - messages of the target that are not mapped;
/// - messages without protection, and answers that do not name their cause.
std::vector<Remark> remarks_on(const Mapping& mapping, const FlownValues& flown = {});

/// The bus load of the mapping's messages, if every frame has its greatest possible length. Messages without
/// a cycle time are not included.
double load_of(const Mapping& mapping, const wire::BitRates& rates);

}  // namespace canhil::mapping
