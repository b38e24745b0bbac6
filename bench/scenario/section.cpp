#include "bench/scenario/section.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bench/scenario/key_depth.hpp"
#include "bench/scenario/nearest.hpp"
#include "bench/scenario/section_file.hpp"
#include "bench/scenario/toml_settings.hpp"

namespace canhil::scenario {

Section Section::parse(std::string_view text, std::string_view file_name, std::span<const Setting> settings) {
  auto state = std::make_shared<State>();
  state->file = std::make_shared<File>();
  state->file->name = file_name;
  state->file->folder = std::filesystem::path(file_name).parent_path().string();
  if (const auto line = line_of_deep_key(text)) {
    state->file->fail(*line, deep_key);
    return Section(std::move(state));
  }
  try {
    state->file->root = toml::parse(text);
    state->table = &state->file->root;
    for (const Setting& setting : settings) state->file->set(setting);
  } catch (const toml::parse_error& error) {
    state->file->fail(error.source().begin.line, fmt::format("not TOML: {}", error.description()));
  }
  return Section(std::move(state));
}

void Section::look_in(std::string folder) { state_->file->folder = std::move(folder); }

bool Section::has(std::string_view key) const {
  if (state_->file->description != nullptr) state_->file->description->looked_for.insert(path(key));
  return state_->table != nullptr && state_->table->contains(key);
}

int Section::line() const { return static_cast<int>(state_->line); }

std::string Section::path(std::string_view key) const { return state_->path_of(key); }

std::string Section::where(std::string_view key) const {
  return state_->file->where(state_->line_of_key(key));
}

void Section::optional(std::string_view key) { state_->ask(key); }

double Section::number(const Key& key, Limits limits, std::optional<double> fallback) {
  return plain_number(key, limits, fallback) * factor_of(key.name);
}

double Section::plain_number(const Key& key, Limits limits, std::optional<double> fallback) {
  state_->describe(key, described_number("number", limits, fallback));
  const std::string expected = description(limits, "a number");
  const toml::node* node = state_->ask(key.name, expected, fallback.has_value());
  if (node == nullptr) return fallback.value_or(0.0);
  const std::optional<double> value = as_number(*node);
  if (value && holds(limits, *value)) return *value;
  state_->refuse_value(key.name, value ? fmt::format("{} is out of range", *value) : type_of(*node),
                       expected);
  return 0.0;
}

world::Vector3 Section::three(const Key& key, Limits limits) {
  state_->describe(key, described_number("one number or three", limits, 0.0));
  if (!has(key.name)) {
    state_->ask(key.name);
    return world::Vector3::Zero();
  }
  if (!state_->table->get(key.name)->is_array()) return world::Vector3::Constant(number(key.name, limits));
  const auto values =
      state_->numbers<3>(key.name, limits, description(limits, "a number, or an array of three, each"));
  return factor_of(key.name) * world::Vector3(values[0], values[1], values[2]);
}

std::pair<double, double> Section::interval(const Key& key, Limits limits) {
  DescribedKey as = described_number(interval_type, limits, {});
  as.sample = fmt::format("[{0}, {0}]", as.sample);
  state_->describe(key, std::move(as));
  const std::string expected = description(
      limits, std::isfinite(limits.least) ? "an array [low, high], each" : "an array [low, high]");
  if (!has(key.name)) state_->missing.emplace_back(key.name, expected);
  const auto values = state_->numbers<2>(key.name, limits, expected);
  if (values[0] > values[1]) reject(key.name, "is descending", expected);
  return {values[0] * factor_of(key.name), values[1] * factor_of(key.name)};
}

std::int64_t Section::integer(const Key& key, std::int64_t least) {
  const std::optional<std::int64_t> value = whole_number(key, least, true);
  if (!value) state_->missing.emplace_back(key.name, fmt::format("a whole number of at least {}", least));
  return value.value_or(0);
}

std::optional<std::int64_t> Section::optional_integer(const Key& key, std::int64_t least) {
  return whole_number(key, least, false);
}

std::optional<std::int64_t> Section::whole_number(const Key& key, std::int64_t least, bool required) {
  state_->describe(key, {.type = "whole number",
                         .limits = Limits::at_least(static_cast<double>(least)),
                         .required = required,
                         .sample = fmt::format("{}", least)});
  const toml::node* node = state_->ask(key.name);
  if (node == nullptr) return std::nullopt;
  const std::string expected = fmt::format("a whole number of at least {}", least);
  const auto* value = node->as_integer();
  if (value == nullptr) {
    state_->refuse_value(key.name, node->is_floating_point() ? "is not whole" : type_of(*node), expected);
    return 0;
  }
  if (value->get() < least)
    state_->refuse_value(key.name, fmt::format("{} is out of range", value->get()), expected);
  return value->get();
}

bool Section::flag(const Key& key) {
  state_->describe(key, {.type = "true or false", .fallback = "false", .sample = "true"});
  const toml::node* node = state_->ask(key.name);
  if (node == nullptr) return false;
  if (!node->is_boolean()) state_->refuse_value(key.name, type_of(*node), "true or false");
  return node->value_or(false);
}

std::string Section::text(const Key& key, const std::optional<std::string>& fallback) {
  state_->describe(
      key, {.type = "text", .fallback = fallback.value_or(""), .required = !fallback, .sample = "\"x\""});
  constexpr std::string_view expected = "text on one line";
  const std::string* value = state_->text(key.name, expected, fallback.has_value());
  if (value == nullptr) return fallback.value_or("");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  if (value->empty()) reject(key.name, "is empty", expected);
  if (std::ranges::any_of(*value, is_control)) reject(key.name, "has a line break or tab", expected);
  return *value;
}

std::string Section::one_of(const Key& key, std::span<const std::string> names,
                            const std::optional<std::string>& fallback) {
  return choice(key, names, fallback, "one of", {names.begin(), names.end()});
}

std::string Section::given_name(const Key& key, std::span<const std::string> names,
                                const std::optional<std::string>& fallback) {
  return choice(key, names, fallback, "a name", {});
}

std::string Section::choice(const Key& key, std::span<const std::string> names,
                            const std::optional<std::string>& fallback, std::string_view type,
                            std::vector<std::string> words) {
  // A name that the file defines can be unknown because of an error in its definition.
  const auto how = words.empty() ? &File::fail : &File::fail_last;
  state_->describe(key, {.type = std::string(type),
                         .fallback = fallback.value_or(""),
                         .required = !fallback,
                         .words = std::move(words),
                         .sample = names.empty() ? "\"x\"" : fmt::format("\"{}\"", names.front())});
  const std::string* value = state_->text(key.name, expected_instead("", names), fallback.has_value());
  if (value == nullptr) return fallback.value_or("");
  if (std::ranges::find(names, *value) != names.end()) return *value;
  state_->fail(key.name, state_->line_of_key(key.name), fmt::format("'{}' is unknown", *value),
               expected_instead(*value, names), how);
  return {};
}

std::string Section::beside(std::string_view path) const {
  return (std::filesystem::path(state_->file->folder) / path).string();
}

std::uint64_t& Section::files_hash() { return state_->file->files_hash; }
std::vector<std::string>& Section::files() { return state_->file->files; }

std::vector<std::string> Section::some_of(const Key& key, std::span<const std::string> names) {
  state_->describe(key, {.type = "array of names",
                         .words = {names.begin(), names.end()},
                         .sample = names.empty() ? "[]" : fmt::format("[\"{}\"]", names.front())});
  constexpr std::string_view expected = "an array of names";
  std::vector<std::string> chosen;
  for (const toml::node& element : state_->elements(key.name, state_->ask(key.name), expected)) {
    const auto* name = element.as_string();
    if (name == nullptr) {
      reject(key.name, "contains a value that is not a name", expected);
    } else if (std::ranges::find(names, name->get()) == names.end()) {
      reject(key.name, fmt::format("'{}' is unknown", name->get()), expected_instead(name->get(), names));
    } else {
      chosen.push_back(name->get());
    }
  }
  return chosen;
}

std::vector<std::string> Section::texts(const Key& key) {
  state_->describe(key, {.type = "array of texts", .sample = "[\"x\"]"});
  constexpr std::string_view expected = "an array of texts";
  std::vector<std::string> all;
  for (const toml::node& element : state_->elements(key.name, state_->ask(key.name), expected)) {
    if (const auto* text = element.as_string(); text != nullptr && !text->get().empty())
      all.push_back(text->get());
    else
      reject(key.name, "contains a value that is not text", expected);
  }
  return all;
}

std::vector<std::int64_t> Section::integers(const Key& key, std::int64_t least) {
  state_->describe(key, {.type = "array of whole numbers",
                         .limits = Limits::at_least(static_cast<double>(least)),
                         .sample = fmt::format("[{}]", least)});
  const std::string expected = fmt::format("an array of whole numbers of at least {}", least);
  std::vector<std::int64_t> all;
  for (const toml::node& element : state_->elements(key.name, state_->ask(key.name), expected)) {
    if (const auto* number = element.as_integer(); number != nullptr && number->get() >= least)
      all.push_back(number->get());
    else
      reject(key.name, "contains a value that is not one", expected);
  }
  return all;
}

std::vector<std::string> Section::keys() const {
  std::vector<std::pair<std::size_t, std::string>> by_line;
  if (state_->table != nullptr) {
    for (const auto& [key, node] : *state_->table) by_line.emplace_back(line_of(node), key.str());
  }
  std::ranges::stable_sort(by_line, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> all;
  for (auto& [line, key] : by_line) all.push_back(std::move(key));
  return all;
}

bool Section::holds_text(std::string_view key) const {
  return has(key) && state_->table->get(key)->is_string();
}

bool Section::holds_table(std::string_view key) const {
  return has(key) && state_->table->get(key)->is_table();
}

std::vector<Setting> Section::settings() {
  std::vector<Setting> all;
  if (state_->table != nullptr) add_settings(*state_->table, "", all);
  return all;
}

Section Section::table(const Key& key) {
  state_->describe(key, {.type = "table", .sample = "{}"});
  return state_->inside(key.name, state_->ask(key.name, "a table"), state_->path_of(key.name));
}

std::vector<Section> Section::tables(std::string_view key) {
  const std::string expected = fmt::format("at least one [[{}]]", key);
  std::vector<Section> sections;
  for (const toml::node& element : state_->elements(key, state_->ask(key, expected), expected)) {
    sections.push_back(
        state_->inside(key, &element, fmt::format("{}[{}]", state_->path_of(key), sections.size() + 1)));
  }
  return sections;
}

std::vector<Section> Section::table_or_tables(std::string_view key) {
  const bool several = state_->table != nullptr && (*state_->table)[key].is_array();
  return several ? tables(key) : std::vector{table(key)};
}

void Section::describe_optional(const Key& key, std::string_view type, const Limits& limits) {
  DescribedKey as = described_number(type, limits, {});
  as.required = false;
  if (type == interval_type) as.sample = fmt::format("[{0}, {0}]", as.sample);
  state_->describe(key, std::move(as));
}

void Section::reject(std::string_view key, std::string_view what, std::string_view expected) {
  state_->fail(key, state_->line_of_key(key), what, expected);
}

void Section::reject(std::string_view key, const Error& error) {
  state_->file->fail(state_->line_of_key(key), fmt::format("key '{}': {}", path(key), error.message));
}

void Section::missing(std::string_view key, std::string_view expected) {
  state_->missing.emplace_back(key, expected);
  if (state_->file->description == nullptr) return;
  for (DescribedKey& one : state_->file->description->keys) {
    if (one.table == state_->path && one.name == key) one.required = true;
  }
}

void Section::finish(std::string_view unasked) {
  if (state_->table == nullptr) return;
  // The table is sorted by key, not by line. This loop finds the unknown key that comes first in the file.
  const toml::node* unknown = nullptr;
  std::string unknown_key;
  for (const auto& [key, node] : *state_->table) {
    if (std::ranges::find(state_->asked, key.str()) != state_->asked.end()) continue;
    if (unknown != nullptr && line_of(node) >= line_of(*unknown)) continue;
    unknown = &node;
    unknown_key = key.str();
  }
  if (unknown != nullptr)
    state_->fail(unknown_key, line_of(*unknown), unasked, expected_instead(unknown_key, state_->asked),
                 state_->missing.empty() ? &File::collect : &File::fail);
  // The unknown key can be the missing one, misspelt, or a consequence of it.
  for (const auto& [key, expected] : state_->missing)
    state_->fail(key, state_->line_of_key(key), "is missing", expected,
                 unknown == nullptr ? &File::fail_last : &File::fail);
}

std::optional<Error> Section::error() const { return state_->file->error; }

}  // namespace canhil::scenario
