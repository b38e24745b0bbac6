#include "dbc/logs/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

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

std::string LineReader::where() const { return fmt::format("{}:{}", input_.name(), number_); }

Result<std::optional<LineReader::Line>> LineReader::next() {
  auto text = input_.available();
  if (!text) return tl::unexpected(text.error());
  if (text->empty()) return std::optional<Line>();
  ++number_;
  const auto end_of = [](std::string_view in) {
    const void* found = std::memchr(in.data(), '\n', std::min(in.size(), longest_line + 2));
    return found == nullptr ? std::string_view::npos
                            : static_cast<std::size_t>(static_cast<const char*>(found) - in.data());
  };
  std::size_t end = end_of(*text);
  // The line is not yet complete: waits for its end, reading no more than necessary.
  while (end == std::string_view::npos && text->size() < longest_line + 2) {
    const std::size_t before = text->size();
    text = input_.peek(before + 1);
    if (!text) return tl::unexpected(text.error());
    if (text->size() == before) break;
    text = input_.available();
    end = end_of(*text);
  }
  const bool ended = end != std::string_view::npos;
  Line line{.text = ended ? text->substr(0, end) : *text, .ended = ended};
  input_.take(ended ? end + 1 : line.text.size());
  if (line.text.ends_with('\r')) line.text.remove_suffix(1);  // line end of Windows
  if (line.text.size() > longest_line)
    return failure(
        fmt::format("{}: is longer than {} characters, expected a line of a log", where(), longest_line));
  return std::optional(line);
}

}  // namespace canhil::logs
