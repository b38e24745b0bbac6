#include "bench/reference/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/scenario/quantity.hpp"

namespace canhil::reference {
namespace {

constexpr std::size_t most_words_shown = 12;
/// If at least this number of tables in a part have the same key, the key is listed once, at the start of the
/// part.
constexpr std::size_t least_sharing = 4;

std::string unit_of(const scenario::DescribedKey& key) {
  if (key.shown.ends_with("_UNIT")) return "UNIT";
  return std::string(scenario::unit_of("_" + key.name));  // a key may be the unit alone: `percent`
}

std::string in_code(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) all.push_back(fmt::format("`{}`", word));
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string range_of(const scenario::Limits& limits) {
  if (!std::isfinite(limits.least) && !std::isfinite(limits.most)) return "";
  if (!std::isfinite(limits.most))
    return fmt::format("{} {}", limits.above_least ? "above" : "at least", limits.least);
  if (limits.above_least) return fmt::format("above {}, up to {}", limits.least, limits.most);
  return fmt::format("{} to {}", limits.least, limits.most);
}

std::string values_of(const scenario::DescribedKey& key) {
  if (key.type == "one of")
    return key.words.size() > most_words_shown || key.words.empty() ? "a name" : in_code(key.words);
  if (key.type == "array of names" && key.words.size() > most_words_shown) return "array of names";
  const std::string range = range_of(key.limits);
  return range.empty() ? key.type : fmt::format("{}, {}", key.type, range);
}

std::string default_of(const AskedKey& one) {
  if (!one.key.required) return one.key.fallback.empty() ? "" : fmt::format("`{}`", one.key.fallback);
  return one.in_place.empty() ? "required" : fmt::format("required, or {}", in_code(one.in_place));
}

std::string meaning_of(const AskedKey& one) {
  return one.only.empty() ? one.key.meaning : fmt::format("{} {}", one.key.meaning, one.only);
}

/// Escapes '|', which would end the table cell.
std::string cell(std::string_view text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "&#124;" : std::string(1, c);
  return safe;
}

std::string row(const AskedKey& one) {
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", one.key.shown, unit_of(one.key), values_of(one.key),
                     default_of(one), cell(meaning_of(one)));
}

std::string rows(const std::vector<std::string>& all) {
  if (all.empty()) return "";
  return fmt::format("| key | unit | values | default | meaning |\n|---|---|---|---|---|\n{}\n",
                     fmt::join(all, ""));
}

/// The rows that at least least_sharing tables of a part have.
std::vector<std::string> shared_rows(const Part& part) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const Table& table : part.tables) {
    for (const AskedKey& one : table.keys) {
      const std::string text = row(one);
      const auto found = std::ranges::find(counts, text, &std::pair<std::string, std::size_t>::first);
      if (found == counts.end())
        counts.emplace_back(text, 1);
      else
        ++found->second;
    }
  }
  std::vector<std::string> shared;
  for (const auto& [text, count] : counts) {
    if (count >= least_sharing) shared.push_back(text);
  }
  return shared;
}

/// The name of a key that is listed once for its part. If several shared rows have this name and the key is
/// required, the text of default_of() follows in brackets.
std::string reference_to(const AskedKey& one, const std::vector<std::string>& shared) {
  const std::string name = fmt::format("`{}`", one.key.shown), begin = fmt::format("| {} |", name);
  const auto rows = std::ranges::count_if(shared, [&](const auto& row) { return row.starts_with(begin); });
  return rows > 1 && one.key.required ? fmt::format("{} ({})", name, default_of(one)) : name;
}

std::string text_of(const Table& table, const std::vector<std::string>& shared) {
  std::vector<std::string> own, names;
  for (const AskedKey& one : table.keys) {
    const std::string text = row(one);
    if (std::ranges::find(shared, text) == shared.end())
      own.push_back(text);
    else
      names.push_back(reference_to(one, shared));
  }
  std::string text = fmt::format("### `{}`\n\n", table.name);
  if (table.name.find(' ') != std::string::npos) text = fmt::format("### {}\n\n", table.name);
  if (!table.about.empty()) text += table.about + "\n\n";
  if (!names.empty()) text += fmt::format("Shared keys: {}.\n\n", fmt::join(names, ", "));
  if (table.keys.empty()) text += "This kind has no keys of its own.\n\n";
  return text + rows(own);
}

}  // namespace

std::string markdown(const std::vector<Part>& parts) {
  std::string text =
      "# Scenario reference\n\nThis page lists every key of scenario and campaign files, with the unit, "
      "possible values, default and meaning of the key. `hil-bench reference` prints this page from the code "
      "that reads the files; [scenarios.md](scenarios.md) explains how to write a scenario. A key may be "
      "left out unless its default is 'required'. 'required, or `x`' means that one of the two keys is "
      "required: this key or the key `x`. 'Only with `trajectory` `weave`' means that the key is allowed (or "
      "required) only if the key `trajectory` has the value `weave`. In the name of a key, UNIT stands for "
      "the unit of the quantity ([quantities.md](quantities.md)), such as `degps` in `value_degps`. 'One "
      "number or three' means either one number, which is used for all three components, or an array `[N, E, "
      "D]` or `[x, y, z]`. The keys of other files are described elsewhere: those of an acceptance suite in "
      "[accept.md](accept.md#writing-a-suite), those of a mapping file in "
      "[mapping.md](mapping.md#the-mapping) and [protection.md](protection.md).\n\n";
  for (const Part& part : parts) {
    const std::vector<std::string> shared = shared_rows(part);
    text += fmt::format("## {}\n\n", part.title);
    if (!part.about.empty()) text += part.about + "\n\n";
    if (!shared.empty()) text += "Keys that several of these tables share:\n\n" + rows(shared);
    for (const Table& table : part.tables) text += text_of(table, shared);
  }
  text.pop_back();
  return text;
}

std::string json(const std::vector<Part>& parts) {
  auto all = nlohmann::ordered_json::array();
  for (const Part& part : parts) {
    auto tables = nlohmann::ordered_json::array();
    for (const Table& table : part.tables) {
      auto keys = nlohmann::ordered_json::array();
      for (const AskedKey& one : table.keys)
        keys.push_back({{"key", one.key.shown},
                        {"unit", unit_of(one.key)},
                        {"type", one.key.type},
                        {"range", range_of(one.key.limits)},
                        {"words", one.key.words},
                        {"required", one.key.required},
                        {"in_place", one.in_place},
                        {"default", one.key.fallback},
                        {"meaning", one.key.meaning},
                        {"only", one.only}});
      tables.push_back({{"name", table.name}, {"about", table.about}, {"keys", std::move(keys)}});
    }
    all.push_back({{"title", part.title}, {"tables", std::move(tables)}});
  }
  return nlohmann::ordered_json{{"parts", std::move(all)}}.dump(1) + "\n";
}

}  // namespace canhil::reference
