#include "bench/checks/kinds/heartbeat.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Heartbeat Heartbeat::read(scenario::Section& section, const scenario::CheckContext& context) {
  Heartbeat rule;
  if (!context.contract.binding->handshake) {
    std::vector<std::string> own;
    for (const auto& [message, sender] : context.contract.sent_by) own.push_back(message);
    rule.message = section.one_of({"message",
                                   "Message that serves as heartbeat. With a mapping this key is required; "
                                   "without a mapping it is not allowed."},
                                  own);
  }
  rule.silent_at_most_us =
      section.time_us({"silent_at_most_s", "Longest permitted time from one heartbeat to the next."},
                      scenario::Limits::above(0));
  return rule;
}

Finding Heartbeat::judge(const Evidence& evidence) const {
  const double most_s = static_cast<double>(silent_at_most_us) * 1e-6;
  const Expected expected{
      .text = fmt::format("never silent for more than {:g} s", most_s),
      .criterion = {
          .quantity = message, .statistic = "longest silence", .upper = Limit{.value = most_s}, .unit = "s"}};
  if (auto why = unfit(evidence, 1, most_s); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  const double gap_s = longest_silence_s(evidence.seen, message);
  return unless_target_delayed(evidence, 1, most_s,
                               {pass_if(gap_s * 1e6 <= static_cast<double>(silent_at_most_us)),
                                fmt::format("longest gap {:.3f} s", gap_s),
                                expected,
                                {.value = gap_s}});
}

}  // namespace canhil::checks
