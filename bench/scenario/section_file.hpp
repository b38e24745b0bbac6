// The parsed file that sections belong to, and the state of a section. This header includes toml++, which is
// slow to compile. So only section.cpp and edited_text.cpp include this header.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// The most errors of a file that are told.
inline constexpr std::size_t most_errors = 20;

struct Section::File {
  std::string name;
  std::string folder;                // folder of the files that this file names
  std::uint64_t files_hash = 0;      // hash of the files that were read
  std::vector<std::string> files{};  // the files that were read
  toml::table root;
  std::optional<Error> error;
  bool collecting = true;
  Description* description = Describing::current();

  /// A value from a setting has no line in the file.
  [[nodiscard]] std::string where(std::size_t line) const {
    return line == 0 ? name : fmt::format("{}:{}", name, line);
  }

  /// Reports an error, if it is the first: it can be a consequence of an earlier one, and others of it.
  void fail(std::size_t line, std::string_view what) {
    if (!error) collect(line, what);
    collecting = false;
  }
  /// Reports an error that is no consequence of another, but of which others can be one.
  void fail_last(std::size_t line, std::string_view what) {
    collect(line, what);
    collecting = false;
  }
  /// Reports an error that is no consequence of another and has none.
  void collect(std::size_t line, std::string_view what) {
    if (!collecting) return;
    std::string text = one_line(fmt::format("{}: {}", where(line), what));  // a key may contain any character
    if (!error) {
      error = Error{std::move(text)};
    } else if (text != error->message && std::ranges::find(error->more, text) == error->more.end() &&
               error->more.size() < most_errors - 1) {
      error->more.push_back(std::move(text));
    }
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
    if (rest.ends_with('+'))
      add(setting, *table, rest.substr(0, rest.size() - 1), *value.get("value"));
    else
      table->insert_or_assign(rest, *value.get("value"));
  }

  /// A setting whose key ends with a plus sign adds tables to an array, and creates it where it is missing.
  void add(const Setting& setting, toml::table& to, std::string_view key, const toml::node& more) {
    toml::node& present = to.insert(key, toml::array{}).first->second;
    if (!present.is_array() || !more.is_array_of_tables()) {
      const toml::node& wrong = present.is_array() ? more : present;
      return fail(0, fmt::format("key '{}': {}, expected an array of tables", setting.key, type_of(wrong)));
    }
    for (const toml::node& element : *more.as_array()) present.as_array()->push_back(element);
  }
};

struct Section::State {
  std::shared_ptr<File> file;
  const toml::table* table = nullptr;  // null: the table is missing; this is reported as an error
  std::string path;
  std::size_t line = 1;
  std::vector<std::string> asked;
  std::vector<std::pair<std::string, std::string>> missing;  // key, expected value

  /// Records how a key is requested, for the reference of all keys.
  void describe(const Key& key, DescribedKey as) const {
    if (file->description == nullptr) return;
    as.table = path;
    as.name = key.name;
    as.shown = key.shown.empty() ? key.name : key.shown;
    as.meaning = key.meaning;
    file->description->keys.push_back(std::move(as));
  }
  const toml::node* ask(std::string_view key) {
    if (std::ranges::find(asked, key) == asked.end()) asked.emplace_back(key);
    return table == nullptr ? nullptr : table->get(key);
  }
  /// Requests a key, as ask(key) does. An absent key also counts as missing, unless `may_be_absent` is set.
  const toml::node* ask(std::string_view key, std::string_view expected, bool may_be_absent = false) {
    const toml::node* node = ask(key);
    if (node == nullptr && !may_be_absent) missing.emplace_back(key, expected);
    return node;
  }
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }
  [[nodiscard]] std::size_t line_of_key(std::string_view key) const {
    const toml::node* node = table == nullptr ? nullptr : table->get(key);
    return node == nullptr ? line : line_of(*node);
  }
  using Fail = void (File::*)(std::size_t, std::string_view);
  void fail(std::string_view key, std::size_t at, std::string_view what, std::string_view expected,
            Fail how = &File::fail) const {
    ((*file).*how)(at, fmt::format("key '{}': {}, expected {}", path_of(key), what, expected));
  }
  /// Reports a value in place of which the reader has a harmless one.
  void refuse_value(std::string_view key, std::string_view what, std::string_view expected) const {
    fail(key, line_of_key(key), what, expected, &File::collect);
  }
  /// The text of a key. Null: the key is absent, or its value is not a text; only the second case is reported
  /// as an error here.
  const std::string* text(std::string_view key, std::string_view expected, bool may_be_absent) {
    const toml::node* node = ask(key, expected, may_be_absent);
    if (node == nullptr) return nullptr;
    const auto* value = node->as_string();
    if (value == nullptr) fail(key, line_of(*node), type_of(*node), expected);
    return value == nullptr ? nullptr : &value->get();
  }
  /// The elements of an array. The result is empty in three cases: `node` is null, the node is not an array,
  /// or the array is empty. The last two cases are reported as errors.
  const toml::array& elements(std::string_view key, const toml::node* node, std::string_view expected) const {
    static const toml::array none;
    if (node == nullptr) return none;
    const toml::array* array = node->as_array();
    if (array != nullptr && !array->empty()) return *array;
    fail(key, line_of(*node), array == nullptr ? type_of(*node) : "is empty", expected);
    return none;
  }
  /// The table at `node`. If `node` is null, returns a table without keys.
  [[nodiscard]] Section inside(std::string_view key, const toml::node* node, std::string inner_path) const {
    auto state = std::make_shared<State>();
    state->file = file;
    state->path = std::move(inner_path);
    if (node == nullptr) return Section(std::move(state));
    state->line = line_of(*node);
    state->table = node->as_table();
    if (state->table == nullptr) fail(key, state->line, type_of(*node), "a table");
    return Section(std::move(state));
  }
  /// The numbers of an array, or zeros if the array is missing or wrong.
  template <std::size_t n>
  std::array<double, n> numbers(std::string_view key, const Limits& limits, std::string_view expected) {
    const toml::node* node = ask(key);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != n) {
      const std::string what =
          array == nullptr ? type_of(*node) : fmt::format("has {} elements", array->size());
      refuse_value(key, what, expected);
      return {};
    }
    std::array<double, n> values{};
    for (std::size_t i = 0; i < n; ++i) {
      const std::optional<double> value = as_number((*array)[i]);
      if (value && holds(limits, *value)) {
        values[i] = *value;
      } else {
        const std::string what = value ? fmt::format("is {}", *value) : type_of((*array)[i]);
        refuse_value(key, fmt::format("element {} {}", i + 1, what), expected);
      }
    }
    return values;
  }
};

}  // namespace canhil::scenario
