// The parsed file that sections belong to. This header includes toml++, which is slow to compile. So only
// section.cpp and edited_text.cpp include this header.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/scenario/key_depth.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::scenario {

inline std::optional<double> as_number(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  return std::nullopt;
}

inline std::string type_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "is a table";
    case toml::node_type::array:
      return "is an array";
    case toml::node_type::string:
      return "is a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "is a number";
    case toml::node_type::boolean:
      return "is a boolean";
    default:
      return "is a date or time";
  }
}

inline std::size_t line_of(const toml::node& node) { return node.source().begin.line; }

struct Section::File {
  std::string name;
  std::string folder;                // folder of the files that this file names
  std::uint64_t files_hash = 0;      // hash of the files that were read
  std::vector<std::string> files{};  // the files that were read
  toml::table root;
  std::optional<Error> error;
  Description* description = Describing::current();

  /// A value from a setting has no line in the file.
  [[nodiscard]] std::string where(std::size_t line) const {
    return line == 0 ? name : fmt::format("{}:{}", name, line);
  }

  void fail(std::size_t line, std::string_view what) {
    if (error) return;
    error = Error{one_line(fmt::format("{}: {}", where(line), what))};  // a key may contain any character
  }

  /// The table of an array of tables that a part of a setting's key names: by its `name`, or by its number,
  /// counted from 1. Null: the array has none; this is reported as an error.
  toml::table* element(toml::array& array, const Setting& setting, std::string_view of,
                       std::string_view part) {
    std::size_t number = 0;
    for (toml::node& node : array) {
      toml::table* table = node.as_table();
      if (table == nullptr) break;
      const toml::node* own_name = table->get("name");
      if ((own_name != nullptr && own_name->value<std::string>() == part) ||
          fmt::format("{}", ++number) == part)
        return table;
    }
    fail(0, fmt::format("key '{}': no [[{}]] is '{}', expected the name of one, or its number from 1 to {}",
                        setting.key, of, part, array.size()));
    return nullptr;
  }

  /// Sets a value by its key, and creates missing tables.
  void set(const Setting& setting) {
    if (std::ranges::count(setting.key, '.') >= most_key_parts) return fail(0, deep_key);
    toml::table* table = &root;
    std::string_view rest = setting.key;
    const auto next_part = [&rest] {
      const std::string_view part = rest.substr(0, rest.find('.'));
      rest.remove_prefix(part.size() + 1);
      return part;
    };
    while (rest.find('.') != std::string_view::npos) {
      const std::string_view part = next_part();
      toml::node& next = table->insert(part, toml::table{}).first->second;
      toml::array* tables = next.is_array_of_tables() ? next.as_array() : nullptr;
      if (tables != nullptr && rest.find('.') != std::string_view::npos) {
        table = element(*tables, setting, part, next_part());
        if (table == nullptr) return;
        continue;
      }
      table = next.as_table();
      if (table == nullptr) {
        fail(0, fmt::format("key '{}': '{}' {}, expected a table", setting.key, part, type_of(next)));
        return;
      }
    }
    const toml::table value = toml::parse(fmt::format("value = {}", setting.value));
    table->insert_or_assign(rest, *value.get("value"));
  }
};

}  // namespace canhil::scenario
