// Reads the sections with the definitions, defaults and values of attributes.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

struct OwnerName {
  std::string_view keyword;
  std::string_view name;
  Owner owner;
};
constexpr std::array<OwnerName, 8> owner_names{
    {{"", "the network", Owner::network},
     {"BU_", "nodes", Owner::node},
     {"BO_", "messages", Owner::message},
     {"SG_", "signals", Owner::signal},
     {"EV_", "environment variables", Owner::variable},
     {"BU_BO_REL_", "nodes with messages", Owner::node_message},
     {"BU_SG_REL_", "nodes with signals", Owner::node_signal},
     {"BU_EV_REL_", "nodes with environment variables", Owner::node_variable}}};

std::string_view name_of(Owner owner) {
  return std::ranges::find(owner_names, owner, &OwnerName::owner)->name;
}

bool is_relation(Owner owner) { return owner >= Owner::node_message; }

/// Reads a keyword such as BO_, and returns the kind of object that it means. If the next token is no
/// keyword, the attribute belongs to the network.
Owner read_owner(Reader& in, bool relation) {
  Owner owner = Owner::network;
  if (in.peek().kind == TokenKind::word) {
    const auto found = std::ranges::find(owner_names, in.peek().text, &OwnerName::keyword);
    if (found == owner_names.end())
      in.fail(relation ? "BU_BO_REL_, BU_SG_REL_ or BU_EV_REL_" : "BU_, BO_, SG_ or EV_");
    owner = found->owner;
  }
  if (is_relation(owner) != relation)
    in.fail(relation ? "BU_BO_REL_, BU_SG_REL_ or BU_EV_REL_" : "BU_, BO_, SG_ or EV_");
  if (owner != Owner::network) in.take();
  return owner;
}

AttributeDefinition& definition_of(Draft& draft, std::string_view name, bool relation, Position at) {
  const Index& definitions = relation ? draft.relation_definitions : draft.definitions;
  const auto found = definitions.find(name);
  if (found == definitions.end()) {
    fail_at(Rule::undefined_attribute, at,
            fmt::format("attribute \"{}\" is not defined, expected a {} above", name,
                        relation ? "BA_DEF_REL_" : "BA_DEF_"));
  }
  return draft.database.definitions[found->second];
}

std::string joined(const std::vector<std::string>& labels) {
  return fmt::format("\"{}\"", fmt::join(labels, "\", \""));
}

/// Reads the value of an enumeration. The text has either the label or its number.
AttributeValue read_label(Reader& in, const AttributeDefinition& definition) {
  const Position at = in.peek().at;
  std::string label;
  if (in.peek().kind == TokenKind::string) {
    label = in.take().text;
    if (std::ranges::find(definition.labels, label) == definition.labels.end()) {
      fail_at(Rule::attribute_label, at,
              fmt::format("\"{}\" is not a value of attribute \"{}\", expected one of {}", label,
                          definition.name, joined(definition.labels)));
    }
    return label;
  }
  const std::int64_t index = in.integer("a value of the enumeration");
  if (index < 0 || index >= std::ssize(definition.labels)) {
    fail_at(Rule::attribute_label, at,
            fmt::format("{} is not a value of attribute \"{}\", expected 0..{}", index, definition.name,
                        std::ssize(definition.labels) - 1));
  }
  return definition.labels[static_cast<std::size_t>(index)];
}

AttributeValue read_number(Reader& in, Draft& draft, const AttributeDefinition& definition) {
  const Position at = in.peek().at;
  const bool is_whole = definition.type != AttributeType::real;
  AttributeValue value = is_whole ? AttributeValue(in.whole("a value")) : AttributeValue(in.real("a value"));
  const double number =
      is_whole ? static_cast<double>(std::get<std::int64_t>(value)) : std::get<double>(value);
  const bool limited = definition.minimum != 0 || definition.maximum != 0;
  if (limited && !(number >= definition.minimum && number <= definition.maximum)) {
    draft.findings.add(Rule::attribute_range, at,
                       fmt::format("{} is outside of attribute \"{}\", expected {}..{}", number,
                                   definition.name, definition.minimum, definition.maximum));
  }
  return value;
}

AttributeValue read_value(Reader& in, Draft& draft, const AttributeDefinition& definition) {
  switch (definition.type) {
    case AttributeType::text:
      return in.string("a value");
    case AttributeType::enumeration:
      return read_label(in, definition);
    default:
      return read_number(in, draft, definition);
  }
}

void read_limits(Reader& in, Draft& draft, AttributeDefinition& definition, bool whole) {
  if (in.at_section_end()) return;
  const Position at = in.peek().at;
  const auto limit = [&](std::string_view what) {
    return whole ? static_cast<double>(in.whole(what)) : in.limit(what);
  };
  const auto read_both = [&] {
    const double minimum = limit("a minimum");
    definition.maximum = limit("a maximum");
    definition.minimum = minimum;
  };
  in.entry(read_both, [] { return false; });
  if (definition.minimum > definition.maximum) {
    draft.findings.add(
        Rule::attribute_limits, at,
        fmt::format("attribute \"{}\" has minimum {} > maximum {}, expected minimum <= maximum",
                    definition.name, definition.minimum, definition.maximum));
    definition.minimum = definition.maximum = 0;
  }
}

void read_type(Reader& in, Draft& draft, AttributeDefinition& definition) {
  const std::string type = in.peek().text;
  if (type == "INT" || type == "HEX") {
    definition.type = type == "INT" ? AttributeType::integer : AttributeType::hexadecimal;
    in.take();
    read_limits(in, draft, definition, true);
  } else if (type == "FLOAT") {
    definition.type = AttributeType::real;
    in.take();
    read_limits(in, draft, definition, false);
  } else if (type == "STRING") {
    definition.type = AttributeType::text;
    in.take();
  } else if (type == "ENUM") {
    definition.type = AttributeType::enumeration;
    in.take();
    do {
      std::string& label =
          definition.labels.emplace_back();  // a malformed one is empty: others keep their number
      in.entry([&] { label = in.string("a label"); }, [&] { return in.at_mark(','); });
    } while (in.take_mark_if(','));
  } else {
    in.fail("the type INT, HEX, FLOAT, STRING or ENUM");
  }
}

}  // namespace

void read_definition(Reader& in, Draft& draft, bool relation) {
  AttributeDefinition definition;
  definition.owner = read_owner(in, relation);
  const Position at = in.peek().at;
  definition.name = in.string("the name of the attribute");
  Index& definitions = relation ? draft.relation_definitions : draft.definitions;
  if (definitions.contains(definition.name)) {
    fail_at(
        Rule::duplicate_definition, at,
        fmt::format("attribute \"{}\" is defined a second time, expected a unique name", definition.name));
  }
  read_type(in, draft, definition);
  in.semicolon();
  definitions.emplace(definition.name, draft.database.definitions.size());
  draft.database.definitions.push_back(std::move(definition));
}

void read_default(Reader& in, Draft& draft, bool relation) {
  const Position at = in.peek().at;
  AttributeDefinition& definition =
      definition_of(draft, in.string("the name of the attribute"), relation, at);
  if (definition.initial) {
    fail_at(Rule::duplicate_default, at,
            fmt::format("default of attribute \"{}\" a second time, expected it once", definition.name));
  }
  // Some tools write "" if an enumeration has no default.
  const bool none = definition.type == AttributeType::enumeration && in.peek().kind == TokenKind::string &&
                    in.peek().text.empty();
  if (none) {
    in.take();
  } else {
    definition.initial = read_value(in, draft, definition);
  }
  in.semicolon();
}

void read_attribute(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  const std::string name = in.string("the name of the attribute");
  const AttributeDefinition& definition = definition_of(draft, name, false, at);
  const Position owner_at = in.peek().at;
  const Owner owner = read_owner(in, false);
  if (owner != definition.owner) {
    fail_at(Rule::attribute_owner, owner_at,
            fmt::format("attribute \"{}\" given to {}, expected {}", name, name_of(owner),
                        name_of(definition.owner)));
  }
  Attributes* attributes = &draft.database.attributes;
  const Position target_at = in.peek().at;
  if (owner == Owner::node) {
    attributes = &node_of(draft, in.word("a node"), target_at).attributes;
  } else if (owner == Owner::variable) {
    attributes = &variable_of(draft, in.word("an environment variable"), target_at).attributes;
  } else if (owner != Owner::network) {
    Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), target_at);
    attributes = &message.attributes;
    if (owner == Owner::signal) {
      const Position signal_at = in.peek().at;
      attributes = &signal_of(draft, message, in.word("a signal"), signal_at).attributes;
    }
  }
  AttributeValue value = read_value(in, draft, definition);
  in.semicolon();
  if (!attributes->emplace(name, std::move(value)).second) {
    draft.findings.add(Rule::duplicate_attribute, at,
                       fmt::format("attribute \"{}\" given a second time, expected one value", name));
  }
}

void read_relation_attribute(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  RelationAttribute relation;
  relation.attribute = in.string("the name of the attribute");
  const AttributeDefinition& definition = definition_of(draft, relation.attribute, true, at);
  const Position owner_at = in.peek().at;
  relation.owner = read_owner(in, true);
  if (relation.owner != definition.owner) {
    fail_at(Rule::attribute_owner, owner_at,
            fmt::format("attribute \"{}\" given to {}, expected {}", relation.attribute,
                        name_of(relation.owner), name_of(definition.owner)));
  }
  const Position node_at = in.peek().at;
  relation.node = in.word("a node");
  node_of(draft, relation.node, node_at);
  if (relation.owner == Owner::node_variable) {
    const Position target_at = in.peek().at;
    relation.target = in.word("an environment variable");
    variable_of(draft, relation.target, target_at);
  } else {
    if (relation.owner == Owner::node_signal && in.at_word("SG_")) in.take();
    const Position message_at = in.peek().at;
    relation.message_id = static_cast<std::uint32_t>(in.natural("a message id", UINT32_MAX));
    Message& message = message_of(draft, relation.message_id, message_at);
    if (relation.owner == Owner::node_signal) {
      const Position signal_at = in.peek().at;
      relation.target = in.word("a signal");
      signal_of(draft, message, relation.target, signal_at);
    }
  }
  relation.value = read_value(in, draft, definition);
  in.semicolon();
  draft.database.relations.push_back(std::move(relation));
}

}  // namespace canhil::dbc
