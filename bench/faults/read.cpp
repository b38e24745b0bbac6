#include "bench/faults/read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bench/observe/values.hpp"
#include "bench/scenario/foreign.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {
namespace {

using scenario::FaultContext;
using scenario::Section;

// The suffixes that a key for a quantity may have, by the SI unit of the quantity.
constexpr std::array<std::pair<std::string_view, std::array<std::string_view, 3>>, 6> endings{
    {{"rad/s", {"degps", "mradps", "degph"}},
     {"rad", {"deg", "mrad", ""}},
     {"m/s^2", {"mps2", "ug", "g"}},
     {"m/s", {"mps", "kmph", ""}},
     {"m", {"m", "", ""}},
     {"s", {"s", "ms", ""}}}};

std::vector<std::string> keys_of(std::string_view stem, std::string_view si) {
  std::vector<std::string> keys;
  const auto found = std::ranges::find(endings, si, &decltype(endings)::value_type::first);
  if (found == endings.end()) return {std::string(stem)};
  for (const std::string_view ending : found->second) {
    if (!ending.empty()) keys.push_back(fmt::format("{}_{}", stem, ending));
  }
  return keys;
}

bool on_the_bus(const FaultContext& context, std::string_view node) {
  return std::ranges::any_of(context.nodes,
                             [&](const scenario::NodeSettings& one) { return one.table().key == node; });
}

bool is_sample_of_a_node(const MessageInfo& message, const FaultContext& context) {
  return !message.sample_group.empty() &&
         std::ranges::any_of(context.nodes, [&](const scenario::NodeSettings& node) {
           return node.table().closes.sample_group == message.sample_group &&
                  node.table().closes.sender == message.sender;
         });
}

std::vector<const MessageInfo*> messages_by_name(Section& section, const FaultContext& context) {
  std::vector<const MessageInfo*> all;
  std::vector<std::string> sent;
  for (const MessageInfo& message : messages_of(context)) {
    const bool is_sent = context.contract.foreign != nullptr
                             ? message.sender != messages::TargetHeartbeat::info.sender
                             : is_sample_of_a_node(message, context);
    if (is_sent) sent.emplace_back(message.name);
  }
  for (const std::string& name :
       section.some_of({"messages", "Names of the messages that the fault affects."}, sent))
    all.push_back(&*std::ranges::find(messages_of(context), std::string_view(name), &MessageInfo::name));
  return all;
}

std::string words_of(const std::vector<const MessageInfo*>& all) {
  std::vector<std::string_view> names;
  for (const MessageInfo* one : all) names.push_back(one->name);
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

std::span<const MessageInfo> messages_of(const FaultContext& context) {
  if (context.contract.foreign != nullptr) return context.contract.foreign->messages;
  return messages::all_messages;
}

const scenario::NodeTable* read_node(Section& section, const FaultContext& context) {
  std::vector<std::string> names;
  for (const scenario::NodeSettings& node : context.nodes) names.emplace_back(node.table().key);
  const std::string name = section.one_of({"node",
                                           "Node that the fault affects. For faults on the bus, this key "
                                           "stands for all messages of the node and replaces `messages`."},
                                          names);
  const auto found = std::ranges::find(context.nodes, name,
                                       [](const scenario::NodeSettings& node) { return node.table().key; });
  return found == context.nodes.end() ? nullptr : &found->table();
}

OfMessages read_messages(Section& section, const FaultContext& context) {
  OfMessages of;
  if (!section.has("node")) {
    section.optional("node");
    of.all = messages_by_name(section, context);
    if (of.all.empty()) section.missing("messages", "some that a node of the scenario sends, or node");
    of.text = words_of(of.all);
    return of;
  }
  section.refuse("messages", "is given beside node", "one of the two");
  const scenario::NodeTable* node = read_node(section, context);
  if (node == nullptr) return of;
  if (context.contract.foreign != nullptr)
    section.reject("node", "sends no messages of its own where a mapping plays it", "messages in its place");
  for (const MessageInfo& message : messages_of(context)) {
    if (message.sender == node->closes.sender && message.sample_group == node->closes.sample_group)
      of.all.push_back(&message);
  }
  of.text = node->key;
  return of;
}

Measured measured(const mapping::Stimulus& stimulus) {
  return {.message = stimulus.message,
          .signal = observe::signal_of(*stimulus.message, stimulus.signal),
          .factor = stimulus.factor,
          .rate = stimulus.over == mapping::Over::rate,
          .si = stimulus.si};
}

const mapping::Stimulus* read_quantity(Section& section, const FaultContext& context,
                                       const scenario::Key& key) {
  std::vector<std::string> names;
  for (const mapping::Stimulus& one : mapping::stimuli()) {
    if (on_the_bus(context, one.node)) names.push_back(one.name);
  }
  return mapping::find_stimulus(section.one_of(key, names));
}

OfValues read_values(Section& section, const FaultContext& context) {
  OfValues of;
  if (section.has("quantity")) {
    for (const std::string_view key : {"messages", "signal"})
      section.refuse(key, "is given beside quantity", "one of the two");
    const mapping::Stimulus* stimulus =
        read_quantity(section, context,
                      {"quantity",
                       "Measured quantity that the fault changes (faults.md). In place of this key, "
                       "`messages` and `signal` may be given."});
    if (stimulus == nullptr) return of;
    of.all.push_back(measured(*stimulus));
    of.text = stimulus->name;
    return of;
  }
  section.optional("quantity");
  const auto messages = messages_by_name(section, context);
  if (messages.empty()) section.missing("quantity", "a quantity, or messages and signal");
  const std::string name = section.text({"signal",
                                         "Signal of the `messages` that the fault changes. Use `messages` "
                                         "and `signal` together, in place of `quantity`."});
  of.text = words_of(messages);
  for (const MessageInfo* message : messages) {
    if (context.contract.foreign != nullptr) {
      section.reject("messages",
                     fmt::format("{} is from a mapping: '{}' is for canhil's own messages", message->name,
                                 section.text("kind", "")),
                     "another kind, or a quantity");
      continue;
    }
    const SignalInfo* signal = observe::signal_of(*message, name);
    if (signal == nullptr)
      section.reject("signal", fmt::format("{} has no signal '{}'", message->name, name), "one that it has");
    else
      of.all.push_back({.message = message, .signal = signal});
  }
  return of;
}

double read_size(Section& section, std::string_view stem, std::string_view meaning, const OfValues& of,
                 scenario::Limits limits) {
  const std::string_view si = of.all.empty() ? "" : of.all.front().si;
  const std::vector<std::string> keys = keys_of(stem, si);
  std::string given;
  for (const std::string& key : keys) {
    section.optional(key);
    if (!section.has(key)) continue;
    if (!given.empty()) section.reject(key, fmt::format("is given beside {}", given), "one of the two");
    given = key;
  }
  if (given.empty()) {
    section.missing(keys.front(),
                    keys.size() == 1 ? "a number" : fmt::format("one of: {}", fmt::join(keys, ", ")));
    given = keys.front();  // for `hil-bench reference`
  }
  const std::string shown = fmt::format("{}_UNIT", stem);
  const std::string whole_meaning = fmt::format(
      "{0} UNIT stands for the unit of the quantity, as in `{1}_degps`. With `signal`, the key is `{1}` "
      "alone, and its value is in the signal's unit.",
      meaning, stem);
  const scenario::Key key{given, whole_meaning, shown};
  return si.empty() ? section.plain_number(key, limits) : section.number(key, limits);
}

}  // namespace canhil::faults
