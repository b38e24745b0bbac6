// Fills a page's prose with a run's figures at {{names}}: Mustache without escaping.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "bench/report/embedded_file.hpp"

namespace canhil::papers {

/// The words of a name, taken one after another. Throws std::logic_error if none is left.
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

/// Text for {{name}}; or a boolean that selects {{#name}}...{{/name}} or {{^name}}...{{/name}}.
using Value = std::variant<std::string, bool>;
/// The value of a name, by its first word; the other words are arguments: {{times table2 kf_p1}}.
using Names = std::map<std::string, std::function<Value(Words&)>, std::less<>>;

/// A number in a format, which may be an argument: {{rms .3g ssbl ekf_90}}.
std::string number(std::string_view format, double value);

/// The file `page` with its names filled in; {{>other}} includes another of the files. Throws
/// std::logic_error, one line with the tag, if the tag is unknown, has too many or too few words, or has no
/// value. Templates are built into the program, and tests fill all of them.
std::string filled(report::EmbeddedFiles templates, const Names& names);

}  // namespace canhil::papers
