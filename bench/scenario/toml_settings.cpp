#include "bench/scenario/toml_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace canhil::scenario {

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string toml_text(const toml::node& node) {
  if (const auto* real = node.as_floating_point())
    return fmt::format("{}", real->get());  // shortest exact representation
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return std::move(text).str();
}

namespace {

/// The table `value = VALUE`; a string if the text is not exactly one TOML value.
toml::table value_of(std::string_view text) {
  try {
    toml::table table = toml::parse(fmt::format("value = {}", text));
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {  // not a TOML value, so it is a string
  }
  return toml::table{{"value", text}};
}

}  // namespace

Result<std::vector<Setting>> parse_setting(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view key = text.substr(0, equals);
  if (equals == std::string_view::npos || key.empty() || key.starts_with('.') || key.ends_with('.') ||
      key.find("..") != std::string_view::npos)
    return failure(fmt::format("'{}': expected KEY=VALUE, such as slave_imu.period_ms=5", text));
  std::vector<Setting> settings;
  const toml::table table = value_of(text.substr(equals + 1));
  add_settings(table, "", settings);
  for (Setting& setting : settings) {
    setting.key.replace(0, std::string_view("value").size(), key);
    setting.line = 0;  // a command line has no lines
  }
  return settings;
}

Result<std::vector<Setting>> parse_settings(const std::vector<std::string>& texts) {
  std::vector<Setting> all;
  for (const std::string& text : texts) {
    auto settings = parse_setting(text);
    if (!settings) return failure(fmt::format("--set {}", settings.error().message));
    for (Setting& one : *settings) {
      if (std::ranges::find(all, one.key, &Setting::key) != all.end())
        return failure(fmt::format("--set '{}': {} is set already, expected each key once", text, one.key));
      all.push_back(std::move(one));
    }
  }
  return all;
}

void add_settings(const toml::table& table, const std::string& path, std::vector<Setting>& settings) {
  for (const auto& [key, node] : table) {
    const std::string name = path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
    if (const toml::table* inner = node.as_table()) {
      add_settings(*inner, name, settings);
      continue;
    }
    Setting setting{.key = name,
                    .value = toml_text(node),
                    .elements = {},
                    .line = static_cast<int>(node.source().begin.line)};
    if (const toml::array* array = node.as_array()) {
      for (const toml::node& element : *array) setting.elements.push_back(toml_text(element));
    }
    settings.push_back(std::move(setting));
  }
}

}  // namespace canhil::scenario
