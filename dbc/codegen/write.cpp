#include "dbc/codegen/write.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::dbc {
namespace {

constexpr std::uint32_t extended_flag = 0x8000'0000;
constexpr std::string_view nobody = "Vector__XXX";

std::uint32_t written_id(const Message& message) {
  return message.id | (message.extended ? extended_flag : 0U);
}

std::string dbc_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string names_text(const std::vector<ValueName>& values) {
  std::string text;
  for (const ValueName& value : values) text += fmt::format("{} {} ", value.value, dbc_string(value.name));
  return text;
}

std::string signal_text(const Signal& s) {
  return fmt::format(
      " SG_ {} : {}|{}@{}{} ({},{}) [{}|{}] {} {}\n", s.name, s.start_bit, s.length,
      s.byte_order == ByteOrder::little_endian ? 1 : 0, s.type == RawType::unsigned_integer ? '+' : '-',
      s.scale, s.offset, s.minimum, s.maximum, dbc_string(s.unit),
      s.receivers.empty() ? std::string(nobody) : fmt::format("{}", fmt::join(s.receivers, ",")));
}

std::string message_text(const Message& message) {
  std::string text = fmt::format("BO_ {} {}: {} {}\n", written_id(message), message.name, message.size,
                                 message.sender.empty() ? nobody : message.sender);
  for (const Signal& signal : message.signals) text += signal_text(signal);
  return text + "\n";
}

std::string comments_text(const Database& database) {
  std::string text;
  const auto add = [&](const std::string& object, const std::string& comment) {
    if (!comment.empty()) text += fmt::format("CM_ {}{};\n", object, dbc_string(comment));
  };
  add("", database.comment);
  for (const Node& node : database.nodes) add(fmt::format("BU_ {} ", node.name), node.comment);
  for (const Message& message : database.messages) {
    add(fmt::format("BO_ {} ", written_id(message)), message.comment);
    for (const Signal& signal : message.signals)
      add(fmt::format("SG_ {} {} ", written_id(message), signal.name), signal.comment);
  }
  return text;
}

std::string_view owner_text(Owner owner) {
  switch (owner) {
    case Owner::node:
      return "BU_ ";
    case Owner::message:
      return "BO_ ";
    case Owner::signal:
      return "SG_ ";
    default:
      return "";
  }
}

std::string type_text(const AttributeDefinition& definition) {
  const auto limited = [&](std::string_view type) {
    return fmt::format("{} {} {}", type, definition.minimum, definition.maximum);
  };
  switch (definition.type) {
    case AttributeType::integer:
      return limited("INT");
    case AttributeType::hexadecimal:
      return limited("HEX");
    case AttributeType::real:
      return limited("FLOAT");
    case AttributeType::text:
      return "STRING ";
    case AttributeType::enumeration:
      break;
  }
  std::vector<std::string> labels;
  for (const std::string& label : definition.labels) labels.push_back(dbc_string(label));
  return fmt::format("ENUM {}", fmt::join(labels, ","));
}

std::string value_text(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return dbc_string(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value));
}

std::string definitions_text(const Database& database) {
  std::string text, defaults;
  for (const AttributeDefinition& definition : database.definitions) {
    text += fmt::format("BA_DEF_ {}{} {};\n", owner_text(definition.owner), dbc_string(definition.name),
                        type_text(definition));
    if (definition.initial)
      defaults +=
          fmt::format("BA_DEF_DEF_ {} {};\n", dbc_string(definition.name), value_text(*definition.initial));
  }
  return text + defaults;
}

// The text of an attribute value. The value of an enumeration is written as the index of its label.
std::string given_text(const Database& database, Owner owner, const std::string& name,
                       const AttributeValue& value) {
  const auto definition = std::ranges::find_if(database.definitions, [&](const AttributeDefinition& one) {
    return one.owner == owner && one.name == name;
  });
  if (definition == database.definitions.end() || definition->type != AttributeType::enumeration)
    return value_text(value);
  const auto label = std::ranges::find(definition->labels, std::get<std::string>(value));
  return fmt::format("{}", label - definition->labels.begin());
}

std::string attributes_text(const Database& database) {
  std::string text;
  const auto add = [&](Owner owner, const std::string& object, const Attributes& attributes) {
    for (const auto& [name, value] : attributes)
      text +=
          fmt::format("BA_ {} {}{};\n", dbc_string(name), object, given_text(database, owner, name, value));
  };
  add(Owner::network, "", database.attributes);
  for (const Node& node : database.nodes)
    add(Owner::node, fmt::format("BU_ {} ", node.name), node.attributes);
  for (const Message& message : database.messages) {
    add(Owner::message, fmt::format("BO_ {} ", written_id(message)), message.attributes);
    for (const Signal& signal : message.signals)
      add(Owner::signal, fmt::format("SG_ {} {} ", written_id(message), signal.name), signal.attributes);
  }
  return text;
}

std::string signals_text(const Database& database) {
  std::string values, types, groups;
  for (const Message& message : database.messages) {
    const std::uint32_t id = written_id(message);
    for (const Signal& signal : message.signals) {
      if (!signal.values.empty())
        values += fmt::format("VAL_ {} {} {};\n", id, signal.name, names_text(signal.values));
      if (signal.is_float())
        types += fmt::format("SIG_VALTYPE_ {} {} : {};\n", id, signal.name,
                             signal.type == RawType::float32 ? 1 : 2);
    }
    for (const SignalGroup& group : message.groups)
      groups += fmt::format("SIG_GROUP_ {} {} {} : {};\n", id, group.name, group.repetitions,
                            fmt::join(group.signals, " "));
  }
  return values + types + groups;
}

}  // namespace

std::string dbc_text(const Database& database) {
  std::string text = fmt::format(
      "VERSION {}\n\nNS_ :\n\tCM_\n\tBA_DEF_\n\tBA_\n\tVAL_\n\tBA_DEF_DEF_\n\tSIG_VALTYPE_\n\tSIG_GROUP_\n"
      "\tVAL_TABLE_\n\nBS_:\n\nBU_:",
      dbc_string(database.version));
  for (const Node& node : database.nodes) text += " " + node.name;
  text += "\n\n";
  for (const ValueTable& table : database.value_tables)
    text += fmt::format("VAL_TABLE_ {} {};\n", table.name, names_text(table.values));
  text += "\n";
  for (const Message& message : database.messages) text += message_text(message);
  return text + comments_text(database) + "\n" + definitions_text(database) + "\n" +
         attributes_text(database) + "\n" + signals_text(database);
}

}  // namespace canhil::dbc
