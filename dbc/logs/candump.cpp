#include "dbc/logs/candump.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "dbc/logs/formats.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

using logs::ns_per_s;
constexpr unsigned flag_brs = 1;
constexpr unsigned flag_fd = 4;  // Linux 6.1 and later set this flag in every FD frame, and candump shows it

/// Reads a line from left to right, and stores the position of the first error.
class Cursor {
 public:
  explicit Cursor(std::string_view line) : line_(line) {}

  [[nodiscard]] bool at_end() const { return at_ == line_.size(); }
  [[nodiscard]] bool failed() const { return expected_ != nullptr; }
  [[nodiscard]] std::string complaint(std::string_view where) const {
    return fmt::format("{}:{}: expected {}", where, at_ + 1, expected_);
  }
  void expect(bool holds, const char* what) {
    if (!holds && expected_ == nullptr) expected_ = what;
  }

  bool accept(char c) {
    if (failed() || at_end() || line_[at_] != c) return false;
    ++at_;
    return true;
  }
  void require(char c, const char* what) { expect(accept(c), what); }

  /// The characters before the first one for which `is_kind` returns false.
  template <class Kind>
  std::string_view run(Kind is_kind) {
    const std::size_t start = at_;
    while (!failed() && !at_end() && is_kind(line_[at_])) ++at_;
    return line_.substr(start, at_ - start);
  }
  void back(std::size_t count) { at_ -= count; }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
  const char* expected_ = nullptr;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f'); }
bool is_name(char c) { return c > ' ' && c <= '~'; }

unsigned hex_value(char c) {
  if (is_digit(c)) return static_cast<unsigned>(c - '0');
  return static_cast<unsigned>((c | 0x20) - 'a') + 10;
}

std::int64_t decimal(std::string_view digits) {
  std::int64_t value = 0;
  for (const char c : digits) value = value * 10 + (c - '0');
  return value;
}

constexpr std::int64_t last_second = std::numeric_limits<std::int64_t>::max() / ns_per_s - 1;

std::int64_t parse_time(Cursor& cursor) {
  cursor.require('(', "'(' and the time in seconds");
  const std::string_view seconds = cursor.run(is_digit);
  const bool readable = !seconds.empty() && seconds.size() <= 10 && decimal(seconds) <= last_second;
  if (!readable) cursor.back(seconds.size());
  cursor.expect(readable, "the time, seconds up to 9223372035");
  cursor.require('.', "'.' and 6 or 9 digits of the second");
  const std::string_view fraction = cursor.run(is_digit);
  cursor.expect(fraction.size() == 6 || fraction.size() == 9, "6 or 9 digits of the second");
  cursor.require(')', "')' after the time");
  cursor.require(' ', "a space after the time");
  return cursor.failed()
             ? 0
             : decimal(seconds) * ns_per_s + decimal(fraction) * (fraction.size() == 6 ? 1000 : 1);
}

void parse_id(Cursor& cursor, Frame& frame) {
  const std::string_view digits = cursor.run(is_hex);
  std::uint64_t id = 0;
  for (const char c : digits.substr(0, 8)) id = id << 4U | hex_value(c);
  const bool standard = digits.size() == 3 && id <= max_standard_id;
  const bool error = digits.size() == 8 && (id & ~std::uint64_t{max_extended_id}) == 0x2000'0000;
  const bool extended = digits.size() == 8 && id <= max_extended_id;
  if (!standard && !error && !extended) cursor.back(digits.size());
  cursor.expect(standard || error || extended,
                "an id of 3 hex digits up to 7FF, or 8 up to 1FFFFFFF (error frame: 2.......)");
  frame.id = static_cast<std::uint32_t>(id & max_extended_id);
  frame.error = error;
  frame.extended = extended;
}

void parse_data(Cursor& cursor, Frame& frame) {
  cursor.require('#', "'#' after the id");
  if (cursor.accept('#')) {
    const std::string_view flags =
        cursor.run([first = true](char c) mutable { return std::exchange(first, false) && is_hex(c); });
    cursor.expect(!flags.empty() && !frame.error,
                  frame.error ? "no FD error frame" : "a hex digit of FD flags");
    frame.fd = true;
    frame.brs = !flags.empty() && (hex_value(flags[0]) & flag_brs) != 0;
  }
  const std::string_view digits = cursor.run(is_hex);
  cursor.expect(digits.size() % 2 == 0, "two hex digits a byte");
  const std::size_t size = digits.size() / 2;
  const bool fits = size <= Frame::max_size && size_has_dlc(static_cast<std::uint8_t>(size), frame.fd);
  if (!fits) cursor.back(digits.size());
  cursor.expect(fits, frame.fd ? "0-8, 12, 16, 20, 24, 32, 48 or 64 bytes" : "0 to 8 bytes");
  if (cursor.failed()) return;
  frame.size = static_cast<std::uint8_t>(size);
  for (std::size_t i = 0; i < size; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(hex_value(digits[2 * i]) << 4U | hex_value(digits[2 * i + 1]));
  }
}

// True for a remote frame, such as "(1.000000) can0 123#R8". A remote frame requests data and carries none. A
// DBC does not describe remote frames.
bool is_remote(std::string_view line) {
  const std::size_t hash = line.find('#');
  return hash != std::string_view::npos && line.substr(hash + 1).starts_with('R');
}

}  // namespace

std::string format_log_line(const LogEntry& entry) {
  const Frame& frame = entry.frame;
  std::string line = fmt::format(FMT_COMPILE("({}.{:06}) {} "), entry.t_ns / ns_per_s,
                                 entry.t_ns % ns_per_s / 1000, entry.interface);
  const std::uint32_t id = frame.id | (frame.error ? 0x2000'0000U : 0U);
  if (frame.extended || frame.error) {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("{:08X}#"), id);
  } else {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("{:03X}#"), id);
  }
  if (frame.fd)
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("#{:X}"), flag_fd | (frame.brs ? flag_brs : 0));
  for (const std::uint8_t byte : frame.payload())
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("{:02X}"), byte);
  line += entry.transmitted ? " T" : " R";
  return line;
}

Result<LogEntry> parse_log_line(std::string_view line, std::string_view where) {
  Cursor cursor(line);
  LogEntry entry;
  entry.t_ns = parse_time(cursor);
  entry.interface = cursor.run(is_name);
  cursor.expect(!entry.interface.empty(), "the interface's name");
  cursor.require(' ', "a space after the interface's name");
  parse_id(cursor, entry.frame);
  parse_data(cursor, entry.frame);
  if (cursor.accept(' ')) {
    entry.transmitted = cursor.accept('T');
    cursor.expect(entry.transmitted || cursor.accept('R'), "'T' or 'R'");
  }
  cursor.expect(cursor.at_end(), "data as hex digits, then ' T', ' R' or the end of the line");
  if (cursor.failed()) return failure(cursor.complaint(where));
  return entry;
}

namespace logs {
namespace {

class CandumpSink final : public LogSink {
 public:
  explicit CandumpSink(File file) : lines_(std::move(file)) {}
  void write(const LogEntry& entry) override { lines_.write(format_log_line(entry) + '\n'); }
  int close() override { return lines_.close(); }

 private:
  LineWriter lines_;
};

class CandumpSource final : public LogSource {
 public:
  explicit CandumpSource(const std::string& path) : lines_(path) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto line = lines_.next();
      if (!line) return tl::unexpected(line.error());
      if (!*line) return std::optional<LogEntry>();
      const std::string_view text = (*line)->text;
      if (is_remote(text)) continue;
      auto entry = parse_log_line(text, lines_.where());
      if (!entry) return tl::unexpected(entry.error());
      // If the recording program was killed, the last line may end between two data bytes. Such a line must
      // not be read as a shorter frame.
      if (!(*line)->ended)
        return failure(fmt::format("{}:{}: expected the end of the line: the log is cut", lines_.where(),
                                   text.size() + 1));
      return std::optional<LogEntry>(std::move(*entry));
    }
  }

 private:
  LineReader lines_;
};

}  // namespace

std::unique_ptr<LogSink> candump_sink(File file) { return std::make_unique<CandumpSink>(std::move(file)); }

std::unique_ptr<LogSource> candump_source(const std::string& path) {
  return std::make_unique<CandumpSource>(path);
}

}  // namespace logs
}  // namespace canhil
