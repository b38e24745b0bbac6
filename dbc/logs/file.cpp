#include "dbc/logs/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace canhil::logs {

void LineWriter::write(std::string_view text) {
  if (error_ != 0 || !file_)
    return;  // after an error, write nothing more: a log may end early, but must have no gap
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) error_ = errno;
}

int LineWriter::close() {
  if (file_ && std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
  return error_;
}

std::string LineReader::where() const { return fmt::format("{}:{}", path_, number_); }

Result<std::optional<LineReader::Line>> LineReader::next() {
  const bool read =
      static_cast<bool>(file_.getline(line_.data(), static_cast<std::streamsize>(line_.size())));
  auto length = static_cast<std::size_t>(file_.gcount());
  if (!read) {
    if (file_.bad()) return failure(fmt::format("cannot read log '{}' after line {}", path_, number_));
    if (length == 0) return std::optional<Line>();
  }
  ++number_;
  if (!file_.eof() && read) --length;  // gcount() counts the line end too
  if (length > longest_line) {
    return failure(
        fmt::format("{}: is longer than {} characters, expected a line of a log", where(), longest_line));
  }
  Line line{.text = {line_.data(), length}, .ended = !file_.eof()};
  if (line.text.ends_with('\r')) line.text.remove_suffix(1);  // line end of Windows
  return std::optional(line);
}

Result<std::string> beginning_of(const std::string& path, std::size_t most) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(path, ignored);  // opening a directory would succeed
  std::ifstream file(path, std::ios::binary);
  if (!file || is_folder)
    return failure(fmt::format("cannot read log '{}': {}", path, std::strerror(is_folder ? EISDIR : errno)));
  std::string text(most, '\0');
  file.read(text.data(), static_cast<std::streamsize>(most));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace canhil::logs
