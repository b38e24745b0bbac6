// The text of a scenario file with other values in it.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "bench/scenario/section_file.hpp"
#include "bench/scenario/toml_settings.hpp"

namespace canhil::scenario {
namespace {

// The keys that name a file.
constexpr std::array<std::string_view, 3> of_files{"recorded", "file", "mapping"};
constexpr std::string_view of_commands = "program";

std::string absolute(const std::string& path, const std::string& folder) {
  std::error_code unknown;
  return std::filesystem::absolute(std::filesystem::path(folder) / path, unknown).lexically_normal().string();
}

// A word of a command may name a file beside the scenario.
void make_absolute_if_file(toml::node& word, const std::string& folder) {
  auto* text = word.as_string();
  std::error_code unknown;
  if (text == nullptr) return;
  if (std::string path = absolute(text->get(), folder); std::filesystem::is_regular_file(path, unknown))
    *text = std::move(path);
}

void make_paths_absolute(toml::table& table, const std::string& folder) {
  for (auto&& [key, node] : table) {
    if (toml::table* inner = node.as_table()) {
      make_paths_absolute(*inner, folder);
    } else if (toml::array* array = node.as_array()) {
      for (toml::node& element : *array) {
        if (toml::table* of_array = element.as_table()) make_paths_absolute(*of_array, folder);
        if (key.str() == of_commands) make_absolute_if_file(element, folder);
      }
    } else if (auto* path = node.as_string();
               path != nullptr && std::ranges::find(of_files, key.str()) != of_files.end()) {
      *path = absolute(path->get(), folder);
    }
  }
}

// A key with the characters that TOML allows only in quotes is put in quotes.
std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  std::ostringstream text;
  if (!bare) text << toml::value<std::string>(key);
  return bare ? std::string(key) : std::move(text).str();
}

// A value on one line.
std::string value_text(const toml::node& node) {
  std::string text;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) text += (text.empty() ? "" : ", ") + value_text(element);
    return fmt::format("[{}]", text);
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      text += fmt::format("{} {} = {}", text.empty() ? "" : ",", key_text(key.str()), value_text(value));
    return fmt::format("{{{} }}", text);
  }
  return toml_text(node);
}

bool is_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && array->is_array_of_tables();
}

// Writes the values of a table, then its tables, each with a heading.
void write(std::string& out, const toml::table& table, const std::string& path) {
  for (const auto& [key, node] : table) {
    if (!node.is_table() && !is_tables(node))
      out += fmt::format("{} = {}\n", key_text(key.str()), value_text(node));
  }
  for (const auto& [key, node] : table) {
    const std::string inner = path.empty() ? key_text(key.str()) : path + "." + key_text(key.str());
    if (const toml::table* one = node.as_table()) {
      out += fmt::format("\n[{}]\n", inner);
      write(out, *one, inner);
    } else if (is_tables(node)) {
      for (const toml::node& element : *node.as_array()) {
        out += fmt::format("\n[[{}]]\n", inner);
        write(out, *element.as_table(), inner);
      }
    }
  }
}

}  // namespace

std::string Section::edited_text(std::string_view text, std::span<const Setting> settings,
                                 const std::string& folder) {
  File file;
  file.root = toml::parse(text);
  for (const Setting& setting : settings) {
    if (setting.value.empty())
      file.root.erase(setting.key);
    else
      file.set(setting);
  }
  make_paths_absolute(file.root, folder);
  std::string out;
  write(out, file.root, "");
  return out;
}

}  // namespace canhil::scenario
