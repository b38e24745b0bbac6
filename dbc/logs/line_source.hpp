// Reads a log in text form, line by line, with the parser of its format.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "dbc/logs/formats.hpp"

namespace canhil::logs {

/// `Parser` has `Result<Parsed> line(std::string_view text)`, whose error states what was expected; and
/// `bool recognised() const`, see LogSource.
template <class Parser>
class LineSource : public LogSource {
 public:
  /// Reads the lines of `input`.
  explicit LineSource(Input input) : lines_(std::move(input)) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto line = lines_.next();
      if (!line) return tl::unexpected(line.error());
      if (!*line) return std::optional<LogEntry>();
      text_ = (*line)->text;
      auto parsed = parser_.line(text_);
      if (!parsed) return failure(fmt::format("{}: expected {}", lines_.where(), parsed.error().message));
      if (parsed->entry) return std::move(parsed->entry);
      if (!parsed->left_out.empty()) leave_out(parsed->left_out);
    }
  }
  [[nodiscard]] std::string last() const override { return fmt::format("{}: '{}'", lines_.where(), text_); }
  [[nodiscard]] bool recognised() const override { return parser_.recognised(); }

 private:
  LineReader lines_;
  std::string_view text_;
  Parser parser_;
};

}  // namespace canhil::logs
