// Access to files, used by all log formats.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::logs {

inline constexpr std::int64_t ns_per_s = 1'000'000'000;

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
  explicit LineReader(const std::string& path) : file_(path), path_(path) {}

  struct Line {
    std::string_view text;
    bool ended = true;  ///< false: this is the last line, and it has no line end
  };
  /// The next line; nullopt: the file has ended. The text is valid until the next call.
  Result<std::optional<Line>> next();
  /// "FILE:LINE" of the line that was read last.
  [[nodiscard]] std::string where() const;

 private:
  /// The largest length of a line, in characters. It is generous: a line with a frame has about 200
  /// characters.
  static constexpr std::size_t longest_line = 4096;

  std::ifstream file_;
  std::string path_;
  std::vector<char> line_ = std::vector<char>(longest_line + 2);
  std::size_t number_ = 0;
};

/// The first characters of a file, at most `most` of them. Returns an error of one line if the file cannot be
/// read.
Result<std::string> beginning_of(const std::string& path, std::size_t most);

}  // namespace canhil::logs
