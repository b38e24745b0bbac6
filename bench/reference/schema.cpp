// The reference as a JSON schema. A table of the reference describes a table of the file ("[truth]",
// "[[truth.leg]]"), a kind of one ("bias", a fault), or keys that several tables may have.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/reference/report.hpp"

namespace canhil::reference {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_words = 40;  // more: names that a mapping or a plant may add to

Json number_schema(const char* type, const scenario::Limits& limits) {
  Json schema{{"type", type}};
  if (std::isfinite(limits.least)) schema[limits.above_least ? "exclusiveMinimum" : "minimum"] = limits.least;
  if (std::isfinite(limits.most)) schema["maximum"] = limits.most;
  return schema;
}

Json numbers_schema(const scenario::Limits& limits, int count) {
  return {{"type", "array"},
          {"items", number_schema("number", limits)},
          {"minItems", count},
          {"maxItems", count}};
}

Json type_of(const scenario::DescribedKey& key) {
  if (key.type == "number") return number_schema("number", key.limits);
  if (key.type == "whole number") return number_schema("integer", key.limits);
  if (key.type == "one number or three")
    return {{"anyOf", {number_schema("number", key.limits), numbers_schema(key.limits, 3)}}};
  if (key.type == "[low, high]") return numbers_schema(key.limits, 2);
  if (key.type == "true or false") return {{"type", "boolean"}};
  if (key.type == "table") return {{"type", "object"}};
  if (key.type.starts_with("array of whole"))
    return {{"type", "array"}, {"items", number_schema("integer", key.limits)}};
  if (key.type.starts_with("array of")) return {{"type", "array"}, {"items", {{"type", "string"}}}};
  if (key.type == "one of" && !key.words.empty() && key.words.size() <= most_words)
    return {{"enum", key.words}};
  return {{"type", "string"}};
}

// The default as a value of the key's type; null: none, or one in words.
Json default_of(const scenario::DescribedKey& key) {
  if (key.fallback.empty()) return nullptr;
  if (key.type == "true or false") return key.fallback == "true";
  double value = 0;
  const char* end = key.fallback.data() + key.fallback.size();
  const auto read = std::from_chars(key.fallback.data(), end, value);
  if (read.ec == std::errc() && read.ptr == end) return value;
  return key.type == "one of" || key.type == "text" ? Json(key.fallback) : Json();
}

Json schema_of(const AskedKey& one) {
  Json schema = type_of(one.key);
  schema["description"] =
      one.only.empty() ? one.key.meaning : fmt::format("{} {}", one.key.meaning, one.only);
  if (Json value = default_of(one.key); !value.is_null()) schema["default"] = std::move(value);
  return schema;
}

// The name of a key that stands for several as a regular expression: below_UNIT, MARK_before_s.
std::string pattern_of(const std::string& shown) {
  constexpr std::string_view unit = "_UNIT", mark = "MARK";
  if (shown.ends_with(unit)) return fmt::format("^{}_.+$", shown.substr(0, shown.size() - unit.size()));
  if (shown.starts_with(mark)) return fmt::format("^.+{}$", shown.substr(mark.size()));
  return "";
}

Json table_schema(std::string_view about = "") {
  Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  if (!about.empty()) schema["description"] = about;
  return schema;
}

// A key that differs between kinds may be any of them.
void add_alternative(Json& place, Json own) {
  if (place.is_null()) {
    place = std::move(own);
    return;
  }
  if (!place.contains("anyOf") || place.contains("description")) {
    if (place == own) return;
    place = Json{{"anyOf", Json::array({place})}};
  }
  if (std::ranges::find(place["anyOf"], own) == place["anyOf"].end())
    place["anyOf"].push_back(std::move(own));
}

// Adds a key. A key whose name has the unit of a quantity has none if the quantity has no unit.
void add(Json& table, const AskedKey& one) {
  const std::string pattern = pattern_of(one.key.shown);
  if (!pattern.empty()) add_alternative(table["patternProperties"][pattern], schema_of(one));
  const std::string name = one.key.shown.substr(0, one.key.shown.find("_UNIT"));
  if (pattern.empty() || name != one.key.shown) add_alternative(table["properties"][name], schema_of(one));
}

void add(Json& table, const std::vector<AskedKey>& keys) {
  for (const AskedKey& one : keys) add(table, one);
}

bool is_array(const Json& schema) { return schema.is_object() && schema.value("type", "") == "array"; }

// The table of a path such as "truth.vibration.sine"; it and those above it are made. A name in capitals
// stands for any name.
Json& table_at(Json& root, std::string_view path) {
  Json* table = &root;
  while (!path.empty()) {
    if (is_array(*table)) table = &(*table)["items"];
    const std::string name(path.substr(0, path.find('.')));
    path.remove_prefix(std::min(path.size(), name.size() + 1));
    const bool is_any = name.front() >= 'A' && name.front() <= 'Z';
    Json& next = is_any ? (*table)["additionalProperties"] : (*table)["properties"][name];
    if (!next.contains("properties") && !is_array(next)) next = table_schema();
    table = &next;
  }
  return *table;
}

// Makes a table an array of tables.
void repeat(Json& table) { table = Json{{"type", "array"}, {"items", std::move(table)}}; }

bool is_file_table(const std::string& name) { return name.starts_with('[') && name.ends_with(']'); }
std::string path_of(const std::string& name) {
  const std::size_t brackets = name.starts_with("[[") ? 2 : 1;
  return name.substr(brackets, name.size() - 2 * brackets);
}

const Part& part(const std::vector<Part>& parts, std::string_view title) {
  return *std::ranges::find(parts, title, &Part::title);
}

// The tables of a part. The kinds that it has are all in the table of this path.
void add_part(Json& root, const Part& of, std::string_view path) {
  for (const Table& table : of.tables) {
    const bool is_own = is_file_table(table.name);
    Json& own = table_at(root, is_own ? path_of(table.name) : path);
    if (is_own && !table.about.empty()) own["description"] = table.about;
    add(own, table.keys);
    if (table.name.starts_with("[[") && table.name != fmt::format("[[{}]]", path)) repeat(own);
  }
}

// Every sensor, by its own table and as [[sensor]]. Its keys may be those of recorded data or of a program,
// too.
void add_nodes(Json& root, const Part& nodes) {
  Json sensor = table_schema("A further sensor of any kind.");
  for (const Table& table : nodes.tables) {
    if (table.name.starts_with("[[node]]")) continue;
    if (table.name != "[sensor.values.VALUE]") add(sensor, table.keys);
  }
  Json value = table_schema();
  for (const Table& table : nodes.tables) {
    if (table.name == "[sensor.values.VALUE]") add(value, table.keys);
  }
  sensor["properties"]["values"] = {{"type", "object"}, {"additionalProperties", std::move(value)}};
  for (const Table& table : nodes.tables) {
    if (!is_file_table(table.name) || table.name.starts_with("[[") || table.name.starts_with("[sensor."))
      continue;
    Json& own = table_at(root, path_of(table.name));
    add(own, table.keys);
    for (const Table& other : nodes.tables) {
      if (other.name.starts_with("Any ")) add(own, other.keys);
    }
  }
  Json node = table_schema();
  for (const Table& table : nodes.tables) {
    if (table.name == "[[node]]") add(node, table.keys);
  }
  root["properties"]["sensor"] = {{"type", "array"}, {"items", std::move(sensor)}};
  root["properties"]["node"] = {{"type", "array"}, {"items", std::move(node)}};
}

}  // namespace

std::string schema(const std::vector<Part>& parts) {
  Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "Scenario of hil-bench"},
            {"type", "object"},
            {"required", {"title", "duration_s", "seed"}},
            {"additionalProperties", false},
            {"properties", Json::object()}};
  add_part(root, part(parts, "The file"), "");
  add_part(root, part(parts, "Truth and initial errors"), "truth");
  add_part(root, part(parts, "The target"), "target");
  root["properties"]["target"]["properties"]["initial_error"] = root["properties"]["initial_error"];
  Json& parameters = table_at(root, "target.parameters");
  for (const Table& table : part(parts, "Parameters of the target").tables) add(parameters, table.keys);
  parameters["additionalProperties"] = {{"type", "number"}};  // those of another target
  const Json target = root["properties"]["target"];
  root["properties"]["target"] = {{"anyOf", {target, {{"type", "array"}, {"items", target}}}}};
  add_part(root, part(parts, "Plant"), "plant");
  add_nodes(root, part(parts, "Nodes"));
  for (const auto& [title, name] :
       {std::pair("Faults", "fault"), std::pair("Events", "event"), std::pair("Checks", "check")}) {
    add_part(root, part(parts, title), name);
    repeat(root["properties"][name]);
  }
  return root.dump(1) + "\n";
}

}  // namespace canhil::reference
