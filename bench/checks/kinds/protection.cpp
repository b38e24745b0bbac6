#include "bench/checks/kinds/protection.hpp"

#include <fmt/format.h>

#include <array>

#include "bench/checks/evidence.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Protection Protection::read(scenario::Section& section, const scenario::CheckContext& context) {
  Protection rule;
  if (section.has("message")) {
    rule.message =
        section.one_of({"message", "Name of the message to judge; by default all messages of the target."},
                       context.contract.messages);
    if (!section.error() && !context.contract.sent_by.contains(*rule.message))
      section.reject("message", "'" + *rule.message + "' is not a message of the target",
                     "one that it sends");
  }
  section.optional("message");
  if (context.contract.foreign == nullptr)
    section.reject("kind", "'protection' is for targets with a mapping",
                   "'counters', which asks the target itself");
  const auto most = [&](std::string_view key, std::string_view meaning) {
    return section.optional_integer({key, meaning}, 0).value_or(0);
  };
  rule.wrong_checksums_at_most =
      most("wrong_checksums_at_most", "Maximum number of frames with a wrong checksum; 0 if not given.");
  rule.wrong_counters_at_most = most(
      "wrong_counters_at_most", "Maximum number of frames with a wrong or repeated counter; 0 if not given.");
  rule.wrong_sizes_at_most =
      most("wrong_sizes_at_most", "Maximum number of frames with a wrong size; 0 if not given.");
  rule.lost_at_most = most(
      "lost_at_most", "Maximum number of frames that are missing according to the counter; 0 if not given.");
  return rule;
}

Finding Protection::judge(const Evidence& evidence) const {
  const auto messages = evidence.seen.timing.messages;
  Sighting all;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (message && messages[i].name != *message) continue;
    const Sighting& one = evidence.seen.from_target[i];
    all.right += one.right;
    all.wrong_crc += one.wrong_crc;
    all.wrong_counter += one.wrong_counter + one.repeated;
    all.wrong_size += one.wrong_size;
    all.lost += one.lost;
  }
  const bool any = all.right + all.wrong_crc + all.wrong_counter + all.wrong_size > 0;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const bool wanted = message ? messages[i].name == *message : !messages[i].answers.empty();
    const Sighting& one = evidence.seen.from_target[i];
    if (wanted && one.right + one.wrong_crc + one.wrong_counter + one.wrong_size == 0)
      return {Outcome::not_measured, fmt::format("{} never came", messages[i].name), "messages to look at"};
  }
  if (!any) return {Outcome::fail, "no messages of the target", "some"};
  return within_limits(
      std::array<CountLimit, 4>{{{"wrong checksums", wrong_checksums_at_most, all.wrong_crc},
                                 {"wrong counters", wrong_counters_at_most, all.wrong_counter},
                                 {"wrong sizes", wrong_sizes_at_most, all.wrong_size},
                                 {"lost by the counter", lost_at_most, all.lost}}});
}

}  // namespace canhil::checks
