#include "bench/checks/kinds/protection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/rule.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {
namespace {

bool is_sent_by_target(const scenario::DbcVocabulary& contract, const std::string& message) {
  return std::ranges::any_of(contract.binding->messages,
                             [&](const MessageInfo& one) { return one.name == message && is_targets(one); });
}

std::uint64_t arrived(const Sighting& one) {
  return one.right + one.repeated + one.wrong_crc + one.wrong_counter + one.wrong_size;
}

// The frames that the gaps of a counter claim beyond those that can be missing.
std::uint64_t jumped(const Observations& seen, std::size_t message, std::int64_t duration_us,
                     std::size_t estimators) {
  const Sighting& one = seen.from_target[message];
  const MessageInfo& info = seen.timing.messages[message];
  if (one.lost == 0) return 0;
  // A target may send a periodic message somewhat faster than its cycle time.
  const double most_in_period = info.answers.empty() ? 1.1 : 1.0;
  const auto owed = due(seen, info.name, 1e-6 * static_cast<double>(duration_us), estimators);
  if (!owed) return 0;
  const auto most = static_cast<std::uint64_t>(std::ceil(most_in_period * static_cast<double>(*owed)));
  const std::uint64_t missing = most - std::min(most, one.right);
  return one.lost - std::min(one.lost, missing);
}

}  // namespace

Protection Protection::read(scenario::Section& section, const scenario::CheckContext& context) {
  const scenario::DbcVocabulary& contract = context.contract;
  Protection rule;
  if (section.has("message")) {
    rule.message =
        section.one_of({"message", "Name of the message to judge; by default all messages of the target."},
                       contract.messages);
    if (!section.error() && !is_sent_by_target(contract, *rule.message))
      section.reject("message", "'" + *rule.message + "' is not a message of the target",
                     "one that it sends");
    expect_sent(section, context, *rule.message);
  }
  section.optional("message");
  for (const std::string& answer : contract.answers) {
    const auto sender = contract.sent_by.find(answer);
    if (sender == contract.sent_by.end() ||
        std::ranges::find(context.estimators, sender->second) != context.estimators.end())
      rule.answers.push_back(answer);
  }
  const auto most = [&](std::string_view key, std::string_view meaning) {
    return section.optional_integer({key, meaning}, 0);
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
  std::uint64_t jumps = 0;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (message && messages[i].name != *message) continue;
    const Sighting& one = evidence.seen.from_target[i];
    if (arrived(one) > 0) {
      all.has_counter = all.has_counter || one.has_counter;
      all.has_checksum = all.has_checksum || one.has_checksum;
    }
    all.right += one.right;
    all.wrong_crc += one.wrong_crc;
    all.wrong_counter += one.wrong_counter + one.repeated;
    all.wrong_size += one.wrong_size;
    all.lost += one.lost;
    jumps += jumped(evidence.seen, i, evidence.truth.duration_us, evidence.estimators.size());
  }
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const bool wanted = message ? messages[i].name == *message
                                : std::ranges::find(answers, messages[i].name) != answers.end();
    if (wanted && arrived(evidence.seen.from_target[i]) == 0)
      return {Outcome::not_measured,
              fmt::format("{} never came", messages[i].name),
              {.text = "messages to look at"}};
  }
  if (arrived(all) == 0) return {Outcome::fail, "no messages of the target", {.text = "some"}};
  const std::string subject = message.value_or("no message that came");
  const std::string_view verb = message ? " has no " : " has a ";
  if (!all.has_counter && !all.has_checksum)
    return {Outcome::not_measured,
            subject + std::string(verb) + "counter or checksum",
            {.text = "[[protection]] in the mapping"}};
  if (!all.has_checksum && wrong_checksums_at_most)
    return {Outcome::not_measured,
            subject + std::string(verb) + "checksum",
            {.text = "[[protection]] with a checksum"}};
  if (!all.has_counter && (wrong_counters_at_most || lost_at_most))
    return {Outcome::not_measured,
            subject + std::string(verb) + "counter",
            {.text = "[[protection]] with a counter"}};
  // A limit of a protection that no message has would pass whatever the target sends.
  const auto limit = [](bool has, const std::optional<std::int64_t>& at_most) {
    return has ? std::optional(at_most.value_or(0)) : std::nullopt;
  };
  Finding finding = within_limits(std::array<CountLimit, 4>{
      {{"wrong checksums", limit(all.has_checksum, wrong_checksums_at_most), all.wrong_crc},
       {"wrong counters", limit(all.has_counter, wrong_counters_at_most), all.wrong_counter},
       {"wrong sizes", limit(true, wrong_sizes_at_most), all.wrong_size},
       {"lost by the counter", limit(all.has_counter, lost_at_most), all.lost}}});
  const bool only_lost = std::cmp_less_equal(all.wrong_crc, wrong_checksums_at_most.value_or(0)) &&
                         std::cmp_less_equal(all.wrong_counter, wrong_counters_at_most.value_or(0)) &&
                         std::cmp_less_equal(all.wrong_size, wrong_sizes_at_most.value_or(0));
  if (finding.outcome == Outcome::fail && only_lost && jumps == 0 && evidence.seen.receive_overflows > 0) {
    finding.outcome = Outcome::not_measured;
    finding.measured += fmt::format("; the bench's port lost {} frames", evidence.seen.receive_overflows);
  }
  return finding;
}

std::string protection_faults(const scenario::Scenario& scenario, const Observations& seen) {
  const auto messages = seen.timing.messages;
  const auto has_limits = [&](std::string_view message) {
    return std::ranges::any_of(scenario.checks, [&](const scenario::Check& check) {
      const auto* rule = dynamic_cast<const RuleOf<Protection>*>(check.rule.get());
      return rule != nullptr && rule->kind().message.value_or(std::string(message)) == message;
    });
  };
  std::vector<std::string> all;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (has_limits(messages[i].name)) continue;
    const Sighting& one = seen.from_target[i];
    const auto add = [&](std::uint64_t count, std::string_view what) {
      if (count > 0)
        all.push_back(fmt::format("{}: {} of {} frames {}", messages[i].name, count, arrived(one), what));
    };
    add(one.wrong_crc, "with a wrong checksum");
    add(one.wrong_counter, "with a counter that is not allowed");
    add(one.wrong_size, "of a wrong size");
    // A counter comes round while frames with a wrong checksum pass, and cannot be judged then.
    if (one.wrong_crc == 0) add(one.repeated, "repeat the counter of the frame before");
    if (const auto jumps = jumped(seen, i, scenario.duration_us, scenario.targets.size());
        jumps > 0 && one.repeated == 0)
      all.push_back(
          fmt::format("{}: the counter jumps over {} frames that are not missing", messages[i].name, jumps));
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

}  // namespace canhil::checks
