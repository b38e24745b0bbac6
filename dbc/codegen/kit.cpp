#include "dbc/codegen/kit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "dbc/codegen/exchange.hpp"
#include "dbc/codegen/names.hpp"
#include "dbc/codegen/rules.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

struct Group {
  std::string name;
  std::vector<const Message*> messages;  // sorted by id, which is the order of transmission
};

// The groups, sorted by the id of each group's first message.
std::vector<Group> groups_of(const Database& database) {
  std::vector<const Message*> sorted;
  for (const Message& message : database.messages) sorted.push_back(&message);
  std::ranges::sort(sorted, {}, &Message::id);
  std::vector<Group> groups;
  for (const Message* message : sorted) {
    const std::string& name = message->sample_group.empty() ? message->name : message->sample_group;
    auto group = std::ranges::find(groups, name, &Group::name);
    if (group == groups.end()) group = groups.insert(groups.end(), Group{name, {}});
    group->messages.push_back(message);
  }
  return groups;
}

// TargetHeartbeat -> TARGET_HEARTBEAT, los_rate -> LOS_RATE.
std::string upper(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool word =
        i > 0 && std::isupper(c) != 0 && std::isupper(static_cast<unsigned char>(name[i - 1])) == 0;
    if (word && text.back() != '_') text += '_';
    text += static_cast<char>(std::toupper(c));
  }
  return text;
}

std::string c_name(std::string_view of, std::string_view name) {
  return fmt::format("CANHIL_{}_{}", upper(of), upper(identifier(name)));
}

// Returns why the tables of c_header() and python_module() cannot describe the message; an empty string: they
// can.
std::string unfit(const Message& message) {
  if (message.extended || message.fd || message.size > 8)
    return fmt::format("message {}: expected classic CAN of at most 8 bytes with an 11-bit id", message.name);
  if (message.e2e_data_id == 0) return fmt::format("message {}: expected an E2eDataId", message.name);
  return {};
}
std::string unfit(const Signal& signal, std::set<std::string>& names) {
  if (!names.insert(signal.name).second)
    return fmt::format("signal {}: expected a name that is unique in its sample group", signal.name);
  if (signal.byte_order != ByteOrder::little_endian || signal.multiplexor || !signal.multiplexed_by.empty() ||
      signal.type == RawType::float64 || (!signal.is_float() && !raw_range(signal)))
    return fmt::format("signal {}: expected little-endian, not multiplexed, no 64-bit float", signal.name);
  return {};
}

Result<std::vector<Group>> fit_groups(const Database& database, std::string_view dbc_name) {
  const auto wrong = [&](const Position& at, const std::string& what) {
    return failure(fmt::format("{}:{}:{}: {}", dbc_name, at.line, at.column, what));
  };
  if (auto broken = find_breach(database)) return wrong(broken->at, broken->what);
  auto groups = groups_of(database);
  for (const Group& group : groups) {
    std::set<std::string> names;
    for (const Message* message : group.messages) {
      if (const auto why = unfit(*message); !why.empty()) return wrong(message->at, why);
      for (const Signal* signal : members_of(*message)) {
        if (const auto why = unfit(*signal, names); !why.empty()) return wrong(signal->at, why);
      }
    }
  }
  return groups;
}

std::vector<ValueName> ascending(std::vector<ValueName> values) {
  std::ranges::sort(values, {}, &ValueName::value);
  return values;
}

std::string kind_of(const Signal& signal) {
  return signal.is_float() ? "float" : signal.is_signed() ? "signed" : "unsigned";
}

struct Limits {
  std::string lowest, highest;  // limits of the raw value, as number literals of C and Python
};
Limits limits_of(const Signal& signal) {
  if (signal.is_float()) {
    const RealRange range = real_range(signal);
    return {literal(range.lowest), literal(range.highest)};
  }
  const RawRange range = *raw_range(signal);
  const auto text = [&](std::int64_t raw) {
    return signal.is_signed() ? fmt::format("{}.0", raw)
                              : fmt::format("{}.0", static_cast<std::uint64_t>(raw));
  };
  return {text(range.lowest), text(range.highest)};
}

// The index of the named signal among the values of a group; -1: the group has no signal of this name.
int index_of(const Group& group, std::string_view name) {
  int index = 0;
  for (const Message* message : group.messages) {
    for (const Signal* signal : members_of(*message)) {
      if (signal->name == name) return index;
      ++index;
    }
  }
  return -1;
}

// The name of the value table whose values and names are exactly those of the signal; empty: there is no such
// table.
std::string table_of(const Database& database, const Signal& signal) {
  const auto table = std::ranges::find_if(database.value_tables, [&](const ValueTable& one) {
    return ascending(one.values) == ascending(signal.values);
  });
  return signal.values.empty() || table == database.value_tables.end() ? "" : table->name;
}

// A value of the value table Estimator, and the hash of the messages that its runs exchange.
struct OfEstimator {
  ValueName estimator;
  std::uint32_t hash24 = 0;
};
std::vector<OfEstimator> hashes_of(const Database& database) {
  std::vector<OfEstimator> all;
  const std::vector<Exchange> exchanged = exchanges(database);
  const auto table = std::ranges::find(database.value_tables, "Estimator", &ValueTable::name);
  if (table == database.value_tables.end()) return all;
  for (const ValueName& value : ascending(table->values)) {
    const auto own = std::ranges::find(exchanged, value.name, &Exchange::estimator);
    all.push_back({value, own == exchanged.end() ? exchanged.front().hash24 : own->hash24});
  }
  return all;
}

std::string c_tables(const Database& database, const std::vector<Group>& groups) {
  std::string hashes;
  for (const OfEstimator& one : hashes_of(database))
    hashes +=
        fmt::format("  {{{}, 0x{:06X}UL}}, /* {} */\n", one.estimator.value, one.hash24, one.estimator.name);
  std::string signals, messages, listed;
  std::size_t first_signal = 0, first_message = 0;
  for (const Group& group : groups) {
    std::size_t first_value = 0;
    for (const Message* message : group.messages) {
      const auto members = members_of(*message);
      for (const Signal* signal : members) {
        const auto [lowest, highest] = limits_of(*signal);
        signals += fmt::format("  {{{}, {}, CANHIL_{}, {}, {}, {}, {}}}, /* {}.{} */\n", signal->start_bit,
                               signal->length, upper(kind_of(*signal)), literal(signal->scale),
                               literal(signal->offset), lowest, highest, message->name, signal->name);
      }
      messages += fmt::format("  {{0x{:X}, 0x{:X}, {}, CANHIL_GROUP_{}, {}, {}, {}}}, /* {} */\n",
                              message->id, message->e2e_data_id, message->size, upper(group.name),
                              first_signal, members.size(), first_value, message->name);
      first_signal += members.size();
      first_value += members.size();
    }
    listed += fmt::format(
        "  {{{}, {}, {}, {}, {}, {}, {}}}, /* {} */\n", first_message, group.messages.size(), first_value,
        group.messages.front()->sender == "Target" ? 1 : 0, index_of(group, "time_of_validity_us"),
        index_of(group, "cause_time_us"), index_of(group, "cause_counter"), group.name);
    first_message += group.messages.size();
  }
  return fmt::format(
      "#ifdef CANHIL_TABLES\n"
      "enum {{ CANHIL_UNSIGNED, CANHIL_SIGNED, CANHIL_FLOAT }};\n\n"
      "/* value = raw * scale + offset; raw is held in [lowest, highest]. start counts as in an Intel DBC. "
      "*/\n"
      "typedef struct {{ unsigned char start, length, kind; double scale, offset, lowest, highest; }} "
      "canhil_signal;\n"
      "static const canhil_signal canhil_signals[] = {{\n{}}};\n\n"
      "/* Ordered by group, then by transmission. first_value: index of its first value in the group. */\n"
      "typedef struct {{ unsigned short id, data_id; unsigned char size, group; unsigned short first_signal; "
      "unsigned char signals, first_value; }} canhil_message;\n"
      "static const canhil_message canhil_messages[] = {{\n{}}};\n\n"
      "/* time, cause_time, cause_counter: indices among the values; -1: the group has none. */\n"
      "typedef struct {{ unsigned char first_message, messages, values, from_target; signed char time, "
      "cause_time, cause_counter; }} canhil_group;\n"
      "static const canhil_group canhil_groups[] = {{\n{}}};\n\n"
      "/* The hash of the messages that a run with an estimator exchanges. */\n"
      "typedef struct {{ unsigned char estimator; unsigned long hash24; }} canhil_exchange;\n"
      "static const canhil_exchange canhil_exchanges[] = {{\n{}}};\n#endif\n",
      signals, messages, listed, hashes);
}

std::string made_by(std::string_view option, std::string_view dbc_name) {
  return fmt::format("Made by dbcgen {0} from {1}: edit {1} instead.", option, dbc_name);
}

}  // namespace

Result<std::string> c_header(const Database& database, std::string_view dbc_name) {
  const auto groups = fit_groups(database, dbc_name);
  if (!groups) return tl::unexpected(groups.error());
  std::string text = fmt::format("/* {} */\n#ifndef CANHIL_MESSAGES_H\n#define CANHIL_MESSAGES_H\n\n",
                                 made_by("--c", dbc_name));
  for (const ValueTable& table : database.value_tables) {
    text += fmt::format("enum {{ /* {} */\n", table.name);
    const auto values = ascending(table.values);
    for (const ValueName& value : values)
      text += fmt::format("  {} = {}{}\n", c_name(table.name, value.name), value.value,
                          &value == &values.back() ? "" : ",");
    text += "};\n";
  }
  std::size_t most_values = 0, messages = 0;
  text += "\n/* Sample groups; a message without a group forms a group by itself. */\nenum {\n";
  for (const Group& group : *groups) {
    text += fmt::format("  CANHIL_GROUP_{},\n", upper(group.name));
    messages += group.messages.size();
  }
  text += "  CANHIL_GROUPS\n};\n\n/* The values of each group, by their index in its array of doubles. */\n";
  for (const Group& group : *groups) {
    text += "enum {\n";
    std::size_t values = 0;
    for (const Message* message : group.messages) {
      for (const Signal* signal : members_of(*message)) {
        text += fmt::format("  {},{}\n", c_name(group.name, signal->name),
                            signal->unit.empty() ? "" : fmt::format(" /* [{}] */", signal->unit));
        ++values;
      }
    }
    text += fmt::format("  {}\n}};\n", c_name(group.name, "values"));
    most_values = std::max(most_values, values);
  }
  text += fmt::format("\nenum {{ CANHIL_MESSAGES = {}, CANHIL_MOST_VALUES = {} }};\n", messages, most_values);
  text += fmt::format("#define CANHIL_HEARTBEAT_MS {}\n",
                      find_message(database, "TargetHeartbeat") == nullptr
                          ? 0
                          : find_message(database, "TargetHeartbeat")->cycle_time_us / 1000);
  return text + "\n" + c_tables(database, *groups) + "\n#endif\n";
}

Result<std::string> python_module(const Database& database, std::string_view dbc_name) {
  const auto groups = fit_groups(database, dbc_name);
  if (!groups) return tl::unexpected(groups.error());
  std::string text = fmt::format(
      "\"\"\"{}\"\"\"\n\n# estimator: the hash of the messages that its runs exchange\nHASH24 = {{\n",
      made_by("--python", dbc_name));
  for (const OfEstimator& one : hashes_of(database))
    text += fmt::format("    {}: 0x{:06X},\n", in_quotes(one.estimator.name), one.hash24);
  text += "}\n\n# name: {value: name}\nVALUE_TABLES = {\n";
  for (const ValueTable& table : database.value_tables) {
    text += fmt::format("    {}: {{", in_quotes(table.name));
    for (const ValueName& value : ascending(table.values))
      text += fmt::format("{}: {}, ", value.value, in_quotes(value.name));
    text += "},\n";
  }
  text +=
      "}\n\n# Sample groups; a message without a group forms a group by itself. Messages in the order of "
      "transmission: (name, id, data id, "
      "size,\n# signals), a signal: (name, start bit, length, kind, scale, offset, lowest raw value, "
      "highest, value table or None).\n"
      "GROUPS = {\n";
  std::string answers, cycles, from_target;
  for (const Group& group : *groups) {
    text += fmt::format("    {}: (\n", in_quotes(group.name));
    for (const Message* message : group.messages) {
      text += fmt::format("        ({}, 0x{:X}, 0x{:X}, {}, (\n", in_quotes(message->name), message->id,
                          message->e2e_data_id, message->size);
      for (const Signal* signal : members_of(*message)) {
        const auto [lowest, highest] = limits_of(*signal);
        const std::string table = table_of(database, *signal);
        text +=
            fmt::format("            ({}, {}, {}, \"{}\", {}, {}, {}, {}, {}),\n", in_quotes(signal->name),
                        signal->start_bit, signal->length, kind_of(*signal), literal(signal->scale),
                        literal(signal->offset), lowest, highest, table.empty() ? "None" : in_quotes(table));
      }
      text += "        )),\n";
    }
    text += "    ),\n";
    const Message& first = *group.messages.front();
    if (first.cycle_time_us > 0)
      cycles += fmt::format("    {}: {},\n", in_quotes(group.name),
                            static_cast<double>(first.cycle_time_us) / 1000);
    if (first.sender == "Target") from_target += fmt::format("    {},\n", in_quotes(group.name));
    if (first.answers.empty()) continue;
    answers += fmt::format("    {}: (", in_quotes(group.name));
    for (const std::string& answered : first.answers) answers += in_quotes(answered) + ", ";
    answers += "),\n";
  }
  return text + fmt::format(
                    "}}\n\n# Group of answers: the groups that it answers.\nANSWERS = {{\n{}}}\n\n"
                    "CYCLE_MS = {{\n{}}}\n\n# The groups that a target sends.\nFROM_TARGET = {{\n{}}}\n",
                    answers, cycles, from_target);
}

}  // namespace canhil::dbc
