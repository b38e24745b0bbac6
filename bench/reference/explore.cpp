#include "bench/reference/explore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace canhil::reference {
namespace {

using scenario::DescribedKey;
using scenario::Description;

using Settings = std::map<std::string, std::string>;  // "table.key" -> TOML value

/// The maximum number of settings in one text: a key with a word, a key that depends on this word, and a key
/// that depends on both.
constexpr std::size_t most_settings = 3;
/// The value that is tried for a key if only its name is known.
constexpr std::string_view any_value = "1";

std::string path_of(const DescribedKey& key) {
  return key.table.empty() ? key.name : fmt::format("{}.{}", key.table, key.name);
}

std::string toml_of(const std::string& given, const Settings& settings) {
  std::string text = given;
  for (const auto& [path, value] : settings) {
    const auto inner = settings.upper_bound(path + ".");
    const bool has_inner = inner != settings.end() && inner->first.starts_with(path + ".");
    if (!has_inner) text += fmt::format("{} = {}\n", path, value);
  }
  return text;
}

/// A run of the reader: the settings in its text, and the keys that the reader requested.
struct Tried {
  Settings settings;
  std::set<std::size_t> asked;  // indices in found_
};

class Explorer {
 public:
  Explorer(const Read& read, const std::string& given, Depth depth) : read_(read), given_(given) {
    waiting_.emplace_back();
    while (!waiting_.empty()) {
      const Settings settings = std::move(waiting_.front());
      waiting_.pop_front();
      attempt(settings, depth);
    }
  }

  std::vector<AskedKey> found() const {
    std::vector<AskedKey> all;
    for (std::size_t place = 0; place < found_.size(); ++place)
      all.push_back({.key = found_[place], .only = only(place), .in_place = in_place(place)});
    return all;
  }

 private:
  void attempt(const Settings& settings, Depth depth) {
    Description description;
    {
      const scenario::Describing now(description);
      read_(toml_of(given_, settings));
    }
    Tried tried{.settings = settings, .asked = {}};
    for (const DescribedKey& key : description.keys) {
      if (const auto place = place_of(key, settings.contains(path_of(key)), description))
        tried.asked.insert(*place);
    }
    tried_.push_back(std::move(tried));
    if (depth == Depth::as_it_is || settings.size() == most_settings) return;
    for (const DescribedKey& key : description.keys) {
      const std::string path = path_of(key);
      const auto given = settings.find(path);
      const bool guessed = given != settings.end() && given->second == any_value;
      if ((given != settings.end() && !guessed) || !expanded_.insert(path).second) continue;
      if (key.type == "one of")
        for (const std::string& word : key.words) wait(settings, path, fmt::format("\"{}\"", word));
      else if (guessed || key.type == "table" || description.looked_for.contains(path))
        wait(settings, path, key.sample);
    }
    for (const std::string& path : description.looked_for) {
      const auto known = [&](const DescribedKey& key) { return path_of(key) == path; };
      if (std::ranges::none_of(found_, known) && guessed_.insert(path).second)
        wait(settings, path, std::string(any_value));
    }
  }

  void wait(Settings settings, const std::string& path, const std::string& value) {
    if (given_.find(path + " = ") != std::string::npos) return;  // TOML does not allow a key twice
    settings[path] = value;
    waiting_.push_back(std::move(settings));
  }

  /// The index of this key in found_, after adding the key if it is new; nullopt if the key brings no new
  /// information.
  std::optional<std::size_t> place_of(const DescribedKey& key, bool is_there,
                                      const Description& description) {
    const auto same = [&](const DescribedKey& one) {
      return one.table == key.table && one.shown == key.shown;
    };
    const auto described = [](const DescribedKey& one) {
      return scenario::description(one.limits, one.type);
    };
    const auto alike = [&](const DescribedKey& one) {
      return same(one) && described(one) == described(key) &&
             (one.type == "one of" || one.fallback == key.fallback);
    };
    const auto any = std::ranges::find_if(found_, same);
    const auto found = std::ranges::find_if(found_, alike);
    // If a key is present in the text, the reader may request it once more, with other details. The earlier
    // entry stays, but if it lacks a meaning, the later entry replaces it.
    if (is_there && any != found_.end()) {
      if (any->meaning.empty() && !key.meaning.empty()) {
        *any = key;
        any->required = false;
      }
      return static_cast<std::size_t>(any - found_.begin());
    }
    if (found != found_.end()) {
      if (found->meaning.empty()) found->meaning = key.meaning;
      found->required = found->required && key.required;
      return static_cast<std::size_t>(found - found_.begin());
    }
    if (key.meaning.empty() && any != found_.end()) return std::nullopt;
    found_.push_back(key);
    if (is_there && description.looked_for.contains(path_of(key))) {  // requested only if present
      found_.back().required = false;
      found_.back().fallback.clear();
    }
    return found_.size() - 1;
  }

  /// The settings of the runs in which the reader requested a key, without the key's own setting.
  [[nodiscard]] std::vector<Settings> asked_with(std::size_t place) const {
    std::vector<Settings> all;
    for (const Tried& tried : tried_) {
      if (!tried.asked.contains(place)) continue;
      Settings settings = tried.settings;
      settings.erase(path_of(found_[place]));
      all.push_back(std::move(settings));
    }
    return all;
  }

  /// The key at `path`, if a condition may list the words that the key permits. A condition may list them if
  /// their number is between two and most_words. Null for any other key.
  [[nodiscard]] const DescribedKey* word_key(const std::string& path) const {
    constexpr std::size_t most_words = 12;
    const auto found = std::ranges::find_if(found_, [&](const DescribedKey& key) {
      return path_of(key) == path && key.type == "one of" && key.words.size() > 1 &&
             key.words.size() <= most_words;
    });
    return found == found_.end() ? nullptr : &*found;
  }

  static void add(std::vector<std::string>& all, const std::string& one) {
    if (one != any_value && std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  static std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }
  static std::string quoted(std::string_view toml) {
    const bool text = toml.size() >= 2 && toml.front() == '"';
    return fmt::format("`{}`", text ? toml.substr(1, toml.size() - 2) : toml);
  }

  /// A text such as "`trajectory` `weave` or `rest`" for some words of one key.
  static std::string words_of(const std::string& path, const std::vector<std::string>& words) {
    std::vector<std::string> all;
    for (const std::string& word : words) all.push_back(quoted(word));
    return fmt::format("`{}` {}", last_part(path), fmt::join(all, " or "));
  }

  [[nodiscard]] std::string only(std::size_t place) const {
    const std::vector<Settings> with = asked_with(place);
    if (std::ranges::any_of(with, [](const Settings& one) { return one.empty(); })) return not_with(place);
    std::map<std::string, std::vector<std::string>> words;  // by key
    std::vector<std::string> keys;
    for (const Settings& one : with) {
      if (one.size() != 1) continue;
      const auto& [path, value] = *one.begin();
      if (word_key(path) != nullptr)
        add(words[path], value);
      else
        add(keys, path);
    }
    std::vector<std::string> conditions;
    for (const auto& [path, some] : words) {
      if (some.size() == word_key(path)->words.size()) return "";
      if (!some.empty()) conditions.push_back(words_of(path, some));
    }
    for (const std::string& path : keys) {
      if (found_[place].table != path) conditions.push_back(fmt::format("`{}`", last_part(path)));
    }
    return conditions.empty() ? "" : fmt::format("Only with {}.", fmt::join(conditions, ", or "));
  }

  /// For a key that the reader requests from an empty text: the words of other keys that make the reader
  /// ignore this key.
  [[nodiscard]] std::string not_with(std::size_t place) const {
    std::map<std::string, std::vector<std::string>> words;
    for (const Tried& tried : tried_) {
      if (tried.asked.empty() || tried.asked.contains(place) || tried.settings.size() != 1) continue;
      const auto& [path, value] = *tried.settings.begin();
      if (word_key(path) != nullptr) add(words[path], value);
    }
    std::string text;
    for (const auto& [path, some] : words)
      if (some.size() < word_key(path)->words.size())
        text += fmt::format("{}Not with {}.", text.empty() ? "" : " ", words_of(path, some));
    return text;
  }

  [[nodiscard]] std::vector<std::string> in_place(std::size_t place) const {
    std::vector<std::string> keys;
    if (!found_[place].required || !tried_.front().asked.contains(place)) return keys;
    for (const Tried& tried : tried_) {
      if (tried.asked.empty() || tried.asked.contains(place) || tried.settings.size() != 1) continue;
      const std::string& path = tried.settings.begin()->first;
      const auto key = std::ranges::find(found_, path, path_of);
      const bool beside = key != found_.end() && key->table == found_[place].table;
      if (word_key(path) == nullptr || !words_differ(path, place)) {
        if (beside && std::ranges::find(keys, last_part(path)) == keys.end()) keys.push_back(last_part(path));
      }
    }
    return keys;
  }

  /// Whether the reader requests the key at `place` if `path` has one of the tried values. The caller has
  /// found another value of `path` with which the reader does not request the key.
  [[nodiscard]] bool words_differ(const std::string& path, std::size_t place) const {
    return std::ranges::any_of(tried_, [&](const Tried& tried) {
      return tried.settings.size() == 1 && tried.settings.contains(path) && tried.asked.contains(place);
    });
  }

  const Read& read_;
  std::string given_;
  std::deque<Settings> waiting_;
  std::vector<DescribedKey> found_;
  std::vector<Tried> tried_;
  std::set<std::string> expanded_, guessed_;
};

}  // namespace

std::vector<AskedKey> explore(const Read& read, const std::string& given, Depth depth) {
  return Explorer(read, given, depth).found();
}

}  // namespace canhil::reference
