#include "bench/papers/template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <stdexcept>
#include <utility>

namespace canhil::papers {
namespace {

namespace mustache = kainjow::mustache;

class Context final : public mustache::basic_context<std::string> {
 public:
  Context(EmbeddedFiles files, const Names& names) : files_(files), names_(names) {}

  // A section is either shown or hidden; it does not add names.
  void push(const mustache::data* /*data*/) override {}
  void pop() override {}

  [[nodiscard]] const mustache::data* get(const std::string& tag) const override {
    const auto known = known_.find(tag);
    if (known != known_.end()) return &known->second;
    try {
      return &known_.emplace(tag, std::visit([](const auto& v) { return mustache::data(v); }, value_of(tag)))
                  .first->second;
    } catch (const std::exception& error) {
      throw std::logic_error(fmt::format("template: {{{{{}}}}}: {}", tag, error.what()));
    }
  }
  [[nodiscard]] const mustache::data* get_partial(const std::string& name) const override {
    return &known_.emplace("> " + name, file(name)).first->second;
  }

  [[nodiscard]] std::string file(std::string_view name) const {
    const auto found = std::ranges::find(files_, name, &EmbeddedFile::name);
    if (found == files_.end()) throw std::logic_error(fmt::format("template: no file '{}'", name));
    std::string_view text = found->text;
    if (text.find("{{ ") != std::string_view::npos)
      throw std::logic_error(fmt::format("template: '{}': expected no blank behind {{{{", name));
    while (text.ends_with('\n')) text.remove_suffix(1);
    return std::string(text);
  }

 private:
  [[nodiscard]] Value value_of(const std::string& tag) const {
    Words words(tag);
    const auto name = names_.find(words.next());
    if (name == names_.end()) throw std::logic_error("is unknown");
    Value value = name->second(words);
    if (!words.empty()) throw std::logic_error("has too many words");
    // Mustache would accept a boolean where text is expected, and print nothing. Mustache would also accept
    // text where a boolean is expected, and take any text as true. Here both are errors.
    if (std::holds_alternative<bool>(value)) {
      if (stands(tag, "")) throw std::logic_error("is yes or no, expected text");
    } else if (stands(tag, "#") || stands(tag, "^")) {
      throw std::logic_error("is text, expected yes or no");
    } else if (std::get<std::string>(value).empty()) {
      throw std::logic_error("is empty");
    }
    return value;
  }
  [[nodiscard]] bool stands(std::string_view tag, std::string_view sign) const {
    const std::string whole = fmt::format("{{{{{}{}}}}}", sign, tag);
    return std::ranges::any_of(
        files_, [&](const EmbeddedFile& one) { return one.text.find(whole) != std::string_view::npos; });
  }

  EmbeddedFiles files_;
  const Names& names_;
  mutable std::map<std::string, mustache::data> known_;
};

}  // namespace

std::string_view Words::next() {
  const std::string_view all = rest();
  const std::string_view word = all.substr(0, all.find(' '));
  left_ = all.substr(std::min(all.size(), word.size() + 1));
  return word;
}

std::string_view Words::rest() {
  if (left_.empty()) throw std::logic_error("has too few words");
  return std::exchange(left_, {});
}

std::string number(std::string_view format, double value) {
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), value);
}

std::string filled(EmbeddedFiles templates, const Names& names) {
  Context context(templates, names);
  mustache::mustache page(context.file("page"));
  page.set_custom_escape([](const std::string& text) { return text; });
  std::string text = page.is_valid() ? page.render(context) : "";
  if (!page.is_valid()) throw std::logic_error(fmt::format("template: {}", page.error_message()));
  return text;
}

}  // namespace canhil::papers
