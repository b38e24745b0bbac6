// What may befall the fixes of [ssbl] and [gps].
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace canhil::scenario {

class Section;

/// Each fix on its own; all probabilities in [0, 1].
struct FixFaults {
  double loss_probability = 0;     ///< its group is not sent
  double invalid_probability = 0;  ///< sent as invalid
  double outlier_probability = 0;
  double outlier = 0;  ///< horizontal size of an outlier [m]
  std::optional<std::pair<std::int64_t, std::int64_t>>
      silence_us{};  ///< no group valid in this interval is sent
};

/// The keys loss_percent, invalid_percent, outlier_percent, outlier_m and silence_s of a node's section.
FixFaults read_fix_faults(Section& section);

}  // namespace canhil::scenario
