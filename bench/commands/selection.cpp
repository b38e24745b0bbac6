#include "bench/commands/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::commands {
namespace {

std::string lower(std::string_view text) {
  std::string all(text);
  for (char& c : all) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return all;
}

// A recursive descent: or, and, not, a word or an expression in parentheses.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(lower(text)) { next(); }

  Result<Selects> read() {
    Selects all = either();
    if (wrong_.empty() && !word_.empty()) wrong_ = word_;
    if (!wrong_.empty() || text_.empty())
      return failure(fmt::format("'{}': expected words with and, or, not and parentheses{}", text_,
                                 wrong_.empty() ? "" : fmt::format(", not '{}' there", wrong_)));
    return all;
  }

 private:
  void next() {
    at_ = std::min(text_.find_first_not_of(' ', at_), text_.size());
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(" ()", at_), text_.size());
    if (at_ == begin && at_ < text_.size()) ++at_;
    word_ = text_.substr(begin, at_ - begin);
  }
  bool take(std::string_view word) {
    if (word_ != word) return false;
    next();
    return true;
  }
  Selects either() {
    Selects left = both();
    while (take("or"))
      left = [left, right = both()](std::string_view text) { return left(text) || right(text); };
    return left;
  }
  Selects both() {
    Selects left = one();
    while (take("and"))
      left = [left, right = one()](std::string_view text) { return left(text) && right(text); };
    return left;
  }
  Selects one() {
    if (++depth_ > most_depth) return refuse();
    if (take("not")) return [inner = one()](std::string_view text) { return !inner(text); };
    if (take("(")) {
      Selects inner = either();
      if (!take(")")) return refuse();
      return inner;
    }
    if (word_.empty() || word_ == ")" || word_ == "and" || word_ == "or") return refuse();
    Selects word = [word = word_](std::string_view text) {
      return text.find(word) != std::string_view::npos;
    };
    next();
    return word;
  }
  Selects refuse() {
    if (wrong_.empty()) wrong_ = word_.empty() ? "the end" : word_;
    word_.clear();
    return [](std::string_view /*text*/) { return false; };
  }

  static constexpr int most_depth = 1000;  // of words: a text of a command line cannot exhaust the stack
  std::string text_, word_, wrong_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// A scenario without duration_s is refused by its reader. It is not left out here, because a misspelt key
// must not make it disappear from the runs of a folder.
bool is_scenario(const scenario::Section& root) {
  return root.has("duration_s") || ((root.has("truth") || root.has("target")) && !root.has("variant"));
}

}  // namespace

Result<std::vector<std::string>> scenario_files(const std::vector<std::string>& scenarios) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const std::string& given : scenarios) {
    std::error_code error;
    if (!fs::is_directory(given, error)) {
      files.push_back(given);
      continue;
    }
    const std::size_t before = files.size();
    for (auto at = fs::recursive_directory_iterator(given, error); !error && at != fs::end(at);
         at.increment(error)) {
      const fs::path& path = at->path();
      std::error_code unknown;
      if (path.extension() != ".toml" || !fs::is_regular_file(path, unknown)) continue;
      const auto text = read_text_file(path, "a scenario file", scenario::most_toml_bytes);
      if (!text) return tl::unexpected(text.error());
      const auto root = scenario::Section::parse(*text, path.string());
      if (const auto wrong = root.error()) return tl::unexpected(*wrong);
      if (is_scenario(root)) files.push_back(path.string());
    }
    if (error) return failure(fmt::format("{}: cannot be read: {}", given, error.message()));
    if (files.size() == before)
      return failure(fmt::format("{}: has no scenario, expected a TOML file with duration_s in it", given));
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  }
  return files;
}

std::string title_of(const std::string& file) {
  const auto text = read_text_file(file, "a scenario file", scenario::most_toml_bytes);
  if (!text) return "";
  auto root = scenario::Section::parse(*text, file);
  return root.holds_text("title") ? root.text("title") : "";
}

Result<Selects> selection(std::string_view expression) {
  auto selects = Reader(expression).read();
  if (!selects) return selects;
  return [selects = std::move(*selects)](std::string_view text) { return selects(lower(text)); };
}

}  // namespace canhil::commands
