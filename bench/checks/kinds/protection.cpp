#include "bench/checks/kinds/protection.hpp"

#include <array>

#include "bench/checks/evidence.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Protection Protection::read(scenario::Section& section, const scenario::CheckContext& context) {
  Protection rule;
  if (section.has("message")) {
    rule.message = section.one_of("message", context.contract.messages);
    if (!section.error() && !context.contract.sent_by.contains(*rule.message))
      section.reject("message", "'" + *rule.message + "' is none of the target's", "one that it sends");
  }
  section.optional("message");
  if (context.contract.foreign == nullptr)
    section.reject("kind", "'protection' is of targets with a mapping",
                   "'counters', which asks the target itself");
  const auto most = [&](std::string_view key) { return section.optional_integer(key, 0).value_or(0); };
  rule.wrong_checksums_at_most = most("wrong_checksums_at_most");
  rule.wrong_counters_at_most = most("wrong_counters_at_most");
  rule.wrong_sizes_at_most = most("wrong_sizes_at_most");
  rule.lost_at_most = most("lost_at_most");
  return rule;
}

Finding Protection::judge(const Evidence& evidence) const {
  Protected all;
  for (const auto& [name, one] : evidence.seen.protection) {
    if (message && name != *message) continue;
    all.wrong_checksum += one.wrong_checksum;
    all.wrong_counter += one.wrong_counter;
    all.wrong_size += one.wrong_size;
    all.lost += one.lost;
  }
  if (evidence.seen.protection.empty()) return {Outcome::fail, "no messages of the target", "some"};
  return within_limits(
      std::array<CountLimit, 4>{{{"wrong checksums", wrong_checksums_at_most, all.wrong_checksum},
                                 {"wrong counters", wrong_counters_at_most, all.wrong_counter},
                                 {"wrong sizes", wrong_sizes_at_most, all.wrong_size},
                                 {"lost by the counter", lost_at_most, all.lost}}});
}

}  // namespace canhil::checks
