// Lines of a log: written to a file, read from an input.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/logs/input.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::logs {

struct CloseFile {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Writes lines to a file, through a buffer.
class LineWriter {
 public:
  explicit LineWriter(File file) : file_(std::move(file)) {}
  void write(std::string_view text);
  /// Closes the file. Returns the errno of the first error; 0: there was no error.
  int close();

 private:
  File file_;
  int error_ = 0;
};

/// Reads lines of a limited length. The returned lines have no line end.
class LineReader {
 public:
  explicit LineReader(Input input) : input_(std::move(input)) {}

  struct Line {
    std::string_view text;
    bool ended = true;  ///< false: this is the last line, and it has no line end
  };
  /// The next line; nullopt: the input has ended. The text is valid until the next call.
  Result<std::optional<Line>> next();
  /// "NAME:LINE" of the line that was read last.
  [[nodiscard]] std::string where() const;
  /// The text that follows the line that was read last, up to Input::longest_peek bytes. Invalidates that
  /// line.
  Result<std::string_view> following() { return input_.peek(Input::longest_peek); }

 private:
  /// The largest length of a line, in characters. It is generous: a line with a frame has about 400
  /// characters.
  static constexpr std::size_t longest_line = 4096;

  Input input_;
  std::size_t number_ = 0;
};

}  // namespace canhil::logs
