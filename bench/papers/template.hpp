// Fills the {{names}} in a page's prose with numbers and texts from the results. The syntax is that of
// Mustache; nothing is escaped.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "dbc/text/embedded_file.hpp"

namespace canhil::papers {

/// The words of a tag, which the caller reads one after another. Reading throws std::logic_error if no word
/// is left.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}
  std::string_view next();
  /// All remaining words.
  std::string_view rest();
  [[nodiscard]] bool empty() const { return left_.empty(); }

 private:
  std::string_view left_;
};

/// The value of a name: the text for {{name}}, or a boolean that selects {{#name}}...{{/name}} or
/// {{^name}}...{{/name}}.
using Value = std::variant<std::string, bool>;
/// Maps the first word of a tag to the function that computes the value of the tag. The other words are the
/// arguments of the function: {{times table2 kf_p1}}.
using Names = std::map<std::string, std::function<Value(Words&)>, std::less<>>;

/// Formats a number. The format may come from an argument of the tag: {{rms .3g ssbl ekf_90}}.
std::string number(std::string_view format, double value);

/// The template `page` with its names filled in; {{>other}} includes another template. Throws
/// std::logic_error if a tag is unknown, has too many or too few words, or has no value; the message is one
/// line that contains the tag. Templates are built into the program, and tests fill all of them.
std::string filled(EmbeddedFiles templates, const Names& names);

}  // namespace canhil::papers
