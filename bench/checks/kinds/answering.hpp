// Checks that a target keeps answering, whatever its inputs are: answers and heartbeats without gaps, finite
// values, whole frames.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct Answering {
  static constexpr std::string_view kind = "answering";
  static constexpr std::string_view meaning =
      "Passes when three conditions hold. While no fault is active, answers and heartbeats come without a "
      "gap. "
      "All estimates and sigmas are numbers. No frame of the target is damaged.";
  std::vector<Subject> judged;  ///< quantities that are reported with every answer

  static Answering read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::vector<Subject> subjects() const { return judged; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const { return {}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

/// The parts of the window `whole` that no window of `others` covers, in order of time.
std::vector<scenario::Window> without(const scenario::Window& whole, std::vector<scenario::Window> others);

}  // namespace canhil::checks
