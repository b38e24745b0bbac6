#include "bench/scenario/toml_settings.hpp"

#include <fmt/format.h>

#include <sstream>

namespace canhil::scenario {
std::string toml_text(const toml::node& node) {
  if (const auto* real = node.as_floating_point())
    return fmt::format("{}", real->get());  // shortest exact representation
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return std::move(text).str();
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
