// A check that a target reports a state, such as an excluded sensor, when it should and only then.
#pragma once

#include <optional>

#include "bench/checks/estimator.hpp"
#include "bench/checks/kinds/of_faults.hpp"
#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct Flag {
  static constexpr std::string_view kind = "flag";
  static constexpr std::string_view meaning =
      "Passes when a flag is set (or clear) in the answers of a window, and becomes set as often as it "
      "should.";
  std::string estimator{};
  std::string flag{};
  std::string fault{};  ///< of which the window is a part; empty: none
  scenario::Window window{};
  bool set = true;                                                ///< the state that is expected
  double share = 1;                                               ///< of the answers, at least
  std::optional<std::pair<std::int64_t, std::int64_t>> starts{};  ///< how often it becomes set: least, most
  std::shared_ptr<const Condition> condition{};

  static Flag read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

/// Whether a mark is a flag: each answer that could report it says whether it is set.
[[nodiscard]] bool can_be_judged(const estimators::Mark& mark);

}  // namespace canhil::checks
