// Names of more than 32 characters. Tools write a short name where the format has a name, and the full name
// as an attribute of the object.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "dbc/parser/check.hpp"
#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

/// The new names of the objects of one kind: short name -> full name.
using Renamed = std::map<std::string, std::string, std::less<>>;

bool is_name(std::string_view text) {
  const auto fits = [](char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           (static_cast<unsigned char>(c) & 0x80U) != 0;
  };
  return !text.empty() && std::ranges::all_of(text, fits) && !is_keyword(text);
}

/// Gives each object its full name from the attribute `symbol`. An object keeps its short name if the full
/// name is not a name, or is the name of another of the objects.
template <class Objects>
Renamed rename(Findings& findings, Objects& objects, std::string_view symbol) {
  Renamed renamed;
  std::set<std::string, std::less<>> taken;
  for (const auto& object : objects) taken.insert(object.name);
  for (auto& object : objects) {
    const auto found = object.attributes.find(symbol);
    const auto* name = found != object.attributes.end() ? std::get_if<std::string>(&found->second) : nullptr;
    if (name == nullptr || name->empty() || *name == object.name) continue;
    if (!is_name(*name) || !taken.insert(*name).second) {
      findings.add(Rule::long_symbol, object.at,
                   fmt::format("{} \"{}\" of {} cannot be its name, expected a unique name", symbol, *name,
                               object.name));
      continue;
    }
    renamed.emplace(object.name, *name);
    object.name = *name;
  }
  return renamed;
}

void follow(const Renamed& renamed, std::string& name) {
  if (const auto found = renamed.find(name); found != renamed.end()) name = found->second;
}
void follow(const Renamed& renamed, std::vector<std::string>& names) {
  for (std::string& name : names) follow(renamed, name);
}

void rename_signals(Findings& findings, Database& database, Message& message) {
  const Renamed signals = rename(findings, message.signals, "SystemSignalLongSymbol");
  if (signals.empty()) return;
  for (Signal& signal : message.signals) follow(signals, signal.multiplexed_by);
  for (SignalGroup& group : message.groups) follow(signals, group.signals);
  const std::uint32_t id = message.extended ? message.id | extended_flag : message.id;
  for (RelationAttribute& relation : database.relations) {
    if (relation.owner == Owner::node_signal && text_id(relation.message_id) == id)
      follow(signals, relation.target);
  }
}

void rename_nodes(Findings& findings, Database& database) {
  const Renamed nodes = rename(findings, database.nodes, "SystemNodeLongSymbol");
  if (nodes.empty()) return;
  for (Message& message : database.messages) {
    follow(nodes, message.sender);
    follow(nodes, message.further_senders);
    for (Signal& signal : message.signals) follow(nodes, signal.receivers);
  }
  for (EnvironmentVariable& variable : database.variables) follow(nodes, variable.nodes);
  for (RelationAttribute& relation : database.relations) follow(nodes, relation.node);
}

}  // namespace

void use_long_symbols(Findings& findings, Database& database) {
  rename(findings, database.messages, "SystemMessageLongSymbol");
  for (Message& message : database.messages) rename_signals(findings, database, message);
  rename_nodes(findings, database);
  const Renamed variables = rename(findings, database.variables, "SystemEnvVarLongSymbol");
  for (RelationAttribute& relation : database.relations) {
    if (relation.owner == Owner::node_variable) follow(variables, relation.target);
  }
}

}  // namespace canhil::dbc
