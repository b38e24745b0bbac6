#include "bench/scenario/events.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "bench/scenario/binding.hpp"
#include "bench/scenario/nearest.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

using When = Event::When;

constexpr std::string_view any_byte = "..", any_rest = "*";

constexpr std::array<std::pair<std::string_view, When>, 6> moments{{{"at", When::start},
                                                                    {"at_s", When::time},
                                                                    {"when", When::truth},
                                                                    {"flag_set", When::flag},
                                                                    {"flag_clear", When::flag},
                                                                    {"after", When::answered}}};

void read_flag(Section& section, const char* key, std::string_view meaning, const Binding& binding,
               Event& event) {
  event.flag = section.given_name({key, meaning}, binding.flags, "");
  event.flag_set = std::string_view(key) == "flag_set";
}

// The moment: exactly one of its keys.
void read_when(Section& section, const Binding& binding, std::int64_t duration_us,
               std::span<const Event> before, Event& event) {
  std::vector<std::string_view> given;
  for (const auto& [key, when] : moments) {
    if (section.has(key)) {
      given.push_back(key);
      event.when = when;
    }
  }
  const std::string expected = "one of at, at_s, when, flag_set, flag_clear, after";
  if (given.empty()) section.missing("at_s", expected);
  if (given.size() > 1) section.refuse(given[1], fmt::format("has no effect beside {}", given[0]), expected);
  static const std::vector<std::string> ends{"start", "end"};
  const std::string at = section.one_of(
      {"at", "`start`: before the run, as soon as the target's program is there; `end`: after the run."},
      ends, "");
  if (at == "end") event.when = When::end;
  event.at_us = section
                    .optional_time_us({"at_s", "Time of the event."},
                                      Limits::between(0, 1e-6 * static_cast<double>(duration_us)))
                    .value_or(0);
  if (section.has("when"))
    event.condition = read_expression(
        section, "when",
        "Expression over the truth (mapping.md); the event is due at the first time at which it is not 0.");
  section.optional("when");
  const bool clear = section.has("flag_clear");
  read_flag(
      section, clear ? "flag_clear" : "flag_set",
      "A flag of the target (mapping.md); the event is due at the first answer in which it is in this state.",
      binding, event);
  section.optional(clear ? "flag_set" : "flag_clear");
  std::vector<std::string> names;
  for (const Event& one : before) names.push_back(one.name);
  const std::string after = section.given_name(
      {"after", "The name of an earlier event that expects an answer; this one is due at that answer."},
      names, "");
  const auto found = std::ranges::find(before, after, &Event::name);
  if (found != before.end()) {
    event.after = static_cast<std::size_t>(found - before.begin());
    if (!found->expected)
      section.reject("after", fmt::format("'{}' expects no answer", after), "an event with the key expect");
  }
  event.delay_us =
      section.time_us({"delay_s", "Time from this moment to the event."}, Limits::between(0, 86'400), 0);
}

std::vector<std::uint8_t> read_bytes(Section& section, const Binding& binding, const Event& event) {
  const bool has_values = section.has("values");
  if (has_values) section.refuse("request", "has no effect beside values", "one of the two");
  std::vector<std::uint8_t> bytes;
  const std::string text =
      section.text({"request", "The bytes to send, as pairs of hex digits: `22 F1 90`."}, "");
  if (auto table = section.optional_table({"values",
                                           "Instead of `request`: values of the signals of the channel's "
                                           "message, in their units; the others are 0."})) {
    std::vector<std::pair<std::string, double>> values;
    for (const std::string& key : table->keys()) values.emplace_back(key, table->plain_number(key, {}));
    table->finish();
    if (section.error()) return {};
    if (auto encoded = binding.encoded(event.channel, values))
      bytes = std::move(*encoded);
    else
      section.reject("values", encoded.error().message, "values that they can hold");
    return bytes;
  }
  if (text.empty()) {
    section.missing("request", "the bytes to send, or values");
    return bytes;
  }
  const auto pattern = BytePattern::parse(text);
  const auto exact = pattern ? pattern->exact() : std::nullopt;
  if (!exact)
    section.reject("request", pattern ? "leaves bytes open" : pattern.error().message,
                   "pairs of hex digits: 22 F1 90");
  return exact.value_or(bytes);
}

void read_answer(Section& section, bool may_answer, Event& event) {
  const std::string text = section.text(
      {"expect",
       "The bytes of the answer: `62 F1 90 .. *`; `..` is any byte, `*` any number of further bytes."},
      "");
  event.within_us = section.optional_time_us(
      {"within_ms", "Limit of the time from the request to its answer."}, Limits::above(0, 60'000));
  if (text.empty()) {
    section.refuse("within_ms", "has no effect without expect", "expect beside it");
    return;
  }
  if (!may_answer)
    section.reject("expect", "has no effect: the channel has no response", "a channel with a response");
  auto pattern = BytePattern::parse(text);
  if (!pattern)
    section.reject("expect", pattern.error().message, "pairs of hex digits, .. and *: 62 F1 90 .. *");
  else
    event.expected = std::move(*pattern);
}

Event read_event(Section& section, const Binding& binding, std::int64_t duration_us,
                 std::span<const Event> before) {
  Event event;
  event.name =
      section.text({"name", "Unique name, for the reports."}, fmt::format("event {}", before.size() + 1));
  if (const auto same = std::ranges::find(before, event.name, &Event::name); same != before.end())
    section.reject("name",
                   fmt::format("'{}' is the name of event[{}] too", event.name, same - before.begin() + 1),
                   "another name");
  event.requirement = section.text({"requirement", "Id of the requirement, shown in the reports."}, "");
  read_when(section, binding, duration_us, before, event);
  std::vector<std::string> names;
  for (const Binding::Channel& one : binding.channels) names.push_back(one.name);
  const std::string channel =
      section.given_name({"channel", "A channel of the mapping (mapping.md)."}, names);
  const auto found = std::ranges::find(names, channel);
  event.channel = static_cast<std::size_t>(found - names.begin());
  const bool known = found != names.end();
  event.request = known ? read_bytes(section, binding, event) : std::vector<std::uint8_t>{};
  if (!known) {
    section.optional("request");
    section.optional("values");
  } else if (event.request.size() > binding.channels[event.channel].most_bytes) {
    section.reject(
        "request", fmt::format("has {} bytes", event.request.size()),
        fmt::format("at most {}, which the channel carries", binding.channels[event.channel].most_bytes));
  }
  event.times = section.optional_integer({"times", "How often it is sent (default 1)."}, 1).value_or(1);
  event.period_us = section
                        .optional_time_us({"period_ms", "With `times`: time from one to the next."},
                                          Limits::above(0, 3'600'000))
                        .value_or(0);
  if (event.times > 1 && event.period_us == 0)
    section.missing("period_ms", "the time from one to the next, with times");
  if (event.times == 1) section.refuse("period_ms", "has no effect without times", "times beside it");
  read_answer(section, !known || binding.channels[event.channel].answers, event);
  section.finish();
  return event;
}

}  // namespace

Phase phase_of(std::span<const Event> events, const Event& event) {
  switch (event.when) {
    case When::start:
      return Phase::before;
    case When::end:
      return Phase::after;
    case When::answered:
      return phase_of(events, events[event.after]);
    default:
      return Phase::during;
  }
}

Result<BytePattern> BytePattern::parse(std::string_view text) {
  BytePattern pattern;
  while (!text.empty()) {
    if (text.front() == ' ') {
      text.remove_prefix(1);
      continue;
    }
    if (pattern.open_) return failure("has bytes behind *");
    if (text.starts_with(any_rest)) {
      pattern.open_ = true;
      text.remove_prefix(any_rest.size());
      continue;
    }
    const std::string_view pair = text.substr(0, 2);
    std::uint8_t byte = 0;
    const auto [end, error] = std::from_chars(pair.data(), pair.data() + pair.size(), byte, 16);
    if (pair == any_byte)
      pattern.bytes_.emplace_back();
    else if (pair.size() == 2 && error == std::errc() && end == pair.data() + pair.size())
      pattern.bytes_.emplace_back(byte);
    else
      return failure(fmt::format("'{}' is no byte", pair));
    text.remove_prefix(pair.size());
  }
  if (pattern.bytes_.empty() && !pattern.open_) return failure("has no byte");
  return pattern;
}

bool BytePattern::matches(std::span<const std::uint8_t> bytes) const {
  if (bytes.size() < bytes_.size() || (bytes.size() > bytes_.size() && !open_)) return false;
  return std::ranges::equal(bytes_, bytes.first(bytes_.size()), [](const auto& expected, std::uint8_t byte) {
    return !expected || *expected == byte;
  });
}

std::string BytePattern::to_text() const {
  std::string text;
  for (const auto& byte : bytes_)
    text += (text.empty() ? "" : " ") + (byte ? fmt::format("{:02X}", *byte) : std::string(any_byte));
  if (open_) text += (text.empty() ? "" : " ") + std::string(any_rest);
  return text;
}

std::optional<std::vector<std::uint8_t>> BytePattern::exact() const {
  std::vector<std::uint8_t> bytes;
  for (const auto& byte : bytes_) {
    if (!byte) return std::nullopt;
    bytes.push_back(*byte);
  }
  return open_ ? std::nullopt : std::optional(bytes);
}

std::string to_text(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t most = 24;
  return fmt::format("{:02X}{}", fmt::join(bytes.first(std::min(bytes.size(), most)), " "),
                     bytes.size() > most ? fmt::format(" ... ({} bytes)", bytes.size()) : "");
}

std::vector<Event> read_events(Section& root, const Binding& binding, std::int64_t duration_us) {
  std::vector<Event> events;
  if (!root.has("event")) {
    root.optional("event");
    return events;
  }
  if (binding.handshake)
    root.reject("event", "is given, but canhil's own protocol has no channel for it",
                "a target with a mapping");
  for (Section& section : root.tables("event"))
    events.push_back(read_event(section, binding, duration_us, events));
  return events;
}

}  // namespace canhil::scenario
