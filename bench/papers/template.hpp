// A page's prose, with {{names}} where figures of a run come in: Mustache without escaping.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "bench/report/embedded_file.hpp"

namespace canhil::papers {

/// The words of a name, taken one after the other. Throws std::logic_error where none is left.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}
  std::string_view next();
  /// All that are left.
  std::string_view rest();
  [[nodiscard]] bool empty() const { return left_.empty(); }

 private:
  std::string_view left_;
};

/// Text, for {{name}}; or whether {{#name}}...{{/name}} stands there, and {{^name}}...{{/name}} does not.
using Value = std::variant<std::string, bool>;
/// What a name stands for, by its first word; its other words say of what: {{times table2 kf_p1}}.
using Names = std::map<std::string, std::function<Value(Words&)>, std::less<>>;

/// A number in a format, which may be a word of its name: {{rms .3g ssbl ekf_90}}.
std::string number(std::string_view format, double value);

/// The file `page`, filled; {{>other}} is another of the files. Throws std::logic_error, one line that names
/// the tag, where that is unknown, has words too many or too few, or stands for nothing: templates are built
/// into the program, and tests fill every one.
std::string filled(report::EmbeddedFiles templates, const Names& names);

}  // namespace canhil::papers
