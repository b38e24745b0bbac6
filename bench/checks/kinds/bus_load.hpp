// Checks that all frames together occupy less than a given fraction of each second at a given bit rate.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// The load is judged at the bit rates of the rule, and also at the bit rates of the run's own bus if these
/// differ.
struct BusLoad {
  static constexpr std::string_view kind = "bus_load";
  static constexpr std::string_view meaning =
      "Passes when the frames, by their exact lengths, occupy the bus for less than `below_percent` of each "
      "whole second.";
  std::int64_t bitrate = 0;       ///< [bit/s]
  std::int64_t data_bitrate = 0;  ///< bit rate of the data phase of FD frames [bit/s]; 0: the nominal rate
  double below = 0;               ///< fraction: 0.5 is 50 %

  static BusLoad read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
