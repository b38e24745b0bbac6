// Reads the sections with named values, comments and environment variables.
#include <fmt/format.h>

#include <set>

#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

std::vector<ValueName> read_value_names(Reader& in, Draft& draft) {
  std::vector<ValueName> values;
  std::set<RawNumber> named;
  const auto read_value_name = [&] {
    const Position at = in.peek().at;
    const RawNumber value = in.raw_number("';' or a value");
    std::string name = in.string("the name of the value");
    if (named.insert(value).second) {
      values.push_back({value, std::move(name)});
    } else {
      draft.findings.add(Rule::duplicate_value, at,
                         fmt::format("value {} named a second time, expected every value once", value));
    }
  };
  while (!in.at_section_end()) in.entry(read_value_name, [&] { return in.peek().kind == TokenKind::number; });
  in.semicolon();
  return values;
}

}  // namespace

void read_values(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  if (in.peek().kind == TokenKind::word) {
    EnvironmentVariable& variable =
        variable_of(draft, in.word("a message id or an environment variable"), at);
    variable.values = read_value_names(in, draft);
    return;
  }
  Message& message = message_of(draft, in.natural("a message id or an environment variable", UINT32_MAX), at);
  const Position signal_at = in.peek().at;
  Signal& signal = signal_of(draft, message, in.word("a signal"), signal_at);
  if (!signal.values.empty()) {
    fail_at(Rule::duplicate_values, signal_at,
            fmt::format("values of {}.{} a second time, expected VAL_ once", message.name, signal.name));
  }
  signal.values = read_value_names(in, draft);
}

void read_value_table(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  ValueTable table;
  table.name = in.word("the name of the value table");
  auto& tables = draft.database.value_tables;
  if (draft.tables.contains(table.name)) {
    fail_at(Rule::duplicate_table, at,
            fmt::format("value table {} is defined a second time, expected a unique name", table.name));
  }
  table.values = read_value_names(in, draft);
  draft.tables.emplace(table.name, tables.size());
  tables.push_back(std::move(table));
}

void read_variable(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  EnvironmentVariable variable;
  variable.at = at;
  variable.name = in.word("the name of the environment variable");
  auto& variables = draft.database.variables;
  if (draft.variables.contains(variable.name)) {
    fail_at(Rule::duplicate_variable, at,
            fmt::format("environment variable {} is defined a second time, expected a unique name",
                        variable.name));
  }
  in.mark(':');
  variable.type = static_cast<int>(in.natural("the type 0, 1 or 2", 2));
  in.mark('[');
  variable.minimum = in.limit("a minimum");
  in.mark('|');
  variable.maximum = in.limit("a maximum");
  in.mark(']');
  variable.unit = in.string("a unit");
  variable.initial = in.real("the initial value");
  in.natural("the number of the variable", UINT32_MAX);
  in.word("the access type DUMMY_NODE_VECTOR<number>");
  const auto read_node = [&] {
    const Position node_at = in.peek().at;
    std::string node = in.word("an access node");
    if (node == nobody) return;
    check_node(draft, node, node_at);
    variable.nodes.push_back(std::move(node));
  };
  do {
    in.entry(read_node, [&] { return in.at_mark(','); });
  } while (in.take_mark_if(','));
  in.semicolon();
  draft.variables.emplace(variable.name, variables.size());
  variables.push_back(std::move(variable));
}

void read_variable_data(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  EnvironmentVariable& variable = variable_of(draft, in.word("an environment variable"), at);
  in.mark(':');
  variable.data_size = static_cast<unsigned>(in.natural("the size in bytes", UINT32_MAX));
  in.semicolon();
}

void read_comment(Reader& in, Draft& draft) {
  std::string* comment = &draft.database.comment;
  const bool on_object = in.at_word("BU_") || in.at_word("BO_") || in.at_word("SG_") || in.at_word("EV_");
  if (!on_object && in.peek().kind != TokenKind::string) in.fail("BU_, BO_, SG_, EV_ or a comment in quotes");
  const std::string kind = on_object ? in.take().text : "";
  const Position at = in.peek().at;
  if (kind == "BU_") {
    comment = &node_of(draft, in.word("a node"), at).comment;
  } else if (kind == "BO_") {
    comment = &message_of(draft, in.natural("a message id", UINT32_MAX), at).comment;
  } else if (kind == "SG_") {
    Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
    const Position signal_at = in.peek().at;
    comment = &signal_of(draft, message, in.word("a signal"), signal_at).comment;
  } else if (kind == "EV_") {
    comment = &variable_of(draft, in.word("an environment variable"), at).comment;
  }
  *comment = in.string("a comment");
  in.semicolon();
}

}  // namespace canhil::dbc
