#include "bench/faults/read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "bench/nodes/registry.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/wire/turns.hpp"

namespace canhil::faults {
namespace {

using scenario::FaultContext;
using scenario::Section;

// The suffixes that a key for a quantity may have, by the SI unit of the quantity.
constexpr std::array<std::pair<std::string_view, std::array<std::string_view, 3>>, 9> endings{
    {{"rad/s", {"degps", "mradps", "degph"}},
     {"rad", {"deg", "mrad", ""}},
     {"m/s^2", {"mps2", "ug", "g"}},
     {"m/s", {"mps", "kmph", ""}},
     {"m", {"m", "", ""}},
     {"s", {"s", "ms", ""}},
     {"Pa", {"hpa", "pa", ""}},
     {"K", {"k", "", ""}},
     {"T", {"ut", "t", ""}}}};

std::vector<std::string> keys_of(std::string_view stem, std::string_view si) {
  std::vector<std::string> keys;
  const auto found = std::ranges::find(endings, si, &decltype(endings)::value_type::first);
  if (found == endings.end()) return {std::string(stem)};
  for (const std::string_view ending : found->second) {
    if (!ending.empty()) keys.push_back(fmt::format("{}_{}", stem, ending));
  }
  return keys;
}

// Whether a message belongs to the sample group of a node.
bool is_of_node(const MessageInfo& message, const scenario::NodeTable& node, const FaultContext& context) {
  const MessageInfo* closing = context.contract.binding->closing_of(node);
  return closing != nullptr && is_in_group_of(message, *closing);
}

// The kind of the node that sends a message; null: the messages of this bus are not those of single nodes.
const nodes::Kind* kind_of(const MessageInfo& message, const FaultContext& context) {
  const auto found = std::ranges::find_if(context.nodes, [&](const scenario::NodeSettings& node) {
    return is_of_node(message, node.table(), context);
  });
  return found == context.nodes.end() ? nullptr : &nodes::kind_of(found->table());
}

// What a signal carries, in the unit of the signal.
Measured measured(const nodes::SampleSignal& signal, const nodes::Kind& kind) {
  return {.sensor = kind.table.sensor,
          .role = signal.role,
          .index = signal.index,
          .factor = signal.factor,
          .turns = wire::turns(signal.info),
          .name = std::string(signal.message->name)};
}

std::vector<const MessageInfo*> messages_by_name(Section& section, const FaultContext& context) {
  std::vector<const MessageInfo*> all;
  std::vector<std::string> sent;
  for (const MessageInfo& message : messages_of(context)) {
    if (context.contract.binding->is_played(message, context.nodes)) sent.emplace_back(message.name);
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
  return context.contract.binding->messages;
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
  if (context.contract.binding->closing_of(*node) == nullptr)
    section.reject("node", "sends no messages of its own where a mapping plays it", "messages in its place");
  for (const MessageInfo& message : messages_of(context)) {
    if (is_of_node(message, *node, context)) of.all.push_back(&message);
  }
  of.text = node->key;
  return of;
}

const sensors::Kind& sensor_of(const scenario::NodeTable& table) { return *table.sensor; }

namespace {

// The name of the random numbers: that of the message, as results have always depended on it.
std::string stream_of(const sensors::Measurand& measurand) {
  const MessageInfo* message = nodes::carrier(measurand).message;
  return message == nullptr ? measurand.name : std::string(message->name);
}

}  // namespace

Measured measured(const sensors::Measurand& measurand) {
  return {.sensor = measurand.sensor,
          .index = measurand.index,
          .turns = measurand.output().turns,
          .rate = measurand.over == sensors::Over::rate,
          .name = stream_of(measurand)};
}

const sensors::Measurand* read_quantity(Section& section, const FaultContext& context,
                                        const scenario::Key& key) {
  std::vector<std::string> names;
  std::map<std::string_view, const sensors::Measurand*> known;
  for (const scenario::NodeSettings& node : context.nodes) {
    for (const sensors::Measurand& one : sensors::measurands_of(sensor_of(node.table()))) {
      names.push_back(one.name);
      known[one.name] = &one;
    }
  }
  const auto found = known.find(section.one_of(key, names));
  return found == known.end() ? nullptr : found->second;
}

void expect_carried(Section& section, const FaultContext& context, std::string_view key,
                    const sensors::Measurand& measurand) {
  const std::uint64_t values = context.contract.binding->carried(*measurand.sensor).values;
  if ((values >> measurand.index & 1) == 0)
    section.reject(key, fmt::format("'{}' is in no message of the bench", measurand.name),
                   "a quantity that the mapping plays");
}

OfValues read_values(Section& section, const FaultContext& context) {
  OfValues of;
  if (section.has("quantity")) {
    for (const std::string_view key : {"messages", "signal"})
      section.refuse(key, "is given beside quantity", "one of the two");
    const sensors::Measurand* measurand =
        read_quantity(section, context,
                      {"quantity",
                       "Measured quantity that the fault changes (faults.md). In place of this key, "
                       "`messages` and `signal` may be given."});
    if (measurand == nullptr) return of;
    expect_carried(section, context, "quantity", *measurand);
    of.all.push_back(measured(*measurand));
    of.si = measurand->si;
    of.text = measurand->name;
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
    const nodes::Kind* kind = kind_of(*message, context);
    if (kind == nullptr) {
      section.reject("messages",
                     fmt::format("{} is from a mapping: '{}' is for canhil's own messages", message->name,
                                 section.text("kind", "")),
                     "another kind, or a quantity");
      continue;
    }
    const nodes::SampleSignal* signal = nodes::carried(*kind, *message, name);
    if (signal == nullptr) {
      section.reject("signal", fmt::format("{} has no signal '{}'", message->name, name), "one that it has");
      continue;
    }
    of.all.push_back(measured(*signal, *kind));
    of.ranges.push_back({.signal = fmt::format("{} of {}", name, message->name),
                         .lowest = signal->info.minimum,
                         .highest = signal->info.maximum});
  }
  return of;
}

double read_size(Section& section, std::string_view stem, std::string_view meaning, const OfValues& of,
                 scenario::Limits limits) {
  const std::string_view si = of.si;
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
