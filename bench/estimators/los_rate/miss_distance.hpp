// The check that the closest approach of missile and target is below a limit.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::estimators {

struct MissDistance {
  static constexpr std::string_view kind = "miss_distance";
  static constexpr std::string_view meaning =
      "Passes when the closest approach of missile and flight target is below `below_m`.";
  double below = 0;                       ///< [m]
  std::vector<std::string> estimators{};  ///< those whose answers are about what the missile flies to

  static MissDistance read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::vector<std::string> held_against_truth() const;
  [[nodiscard]] checks::Finding judge(const checks::Evidence& evidence) const;
};

}  // namespace canhil::estimators
