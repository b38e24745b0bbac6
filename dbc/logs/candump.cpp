#include "dbc/logs/candump.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "dbc/logs/candump_screen.hpp"
#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

using logs::ns_per_s;
constexpr unsigned flag_brs = 1, flag_esi = 2;
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

// The part "R" or "R8" of a remote frame, after '#'.
void parse_request(Cursor& cursor, LogEntry& entry) {
  entry.remote = true;
  const std::string_view digits = cursor.run(is_digit);
  const bool fits = digits.empty() || (digits.size() == 1 && digits[0] <= '8');
  if (!fits) cursor.back(digits.size());
  cursor.expect(fits, "a size of 0 to 8 bytes");
  cursor.expect(!entry.frame.error, "no remote error frame");
  entry.frame.size = fits && !digits.empty() ? static_cast<std::uint8_t>(digits[0] - '0') : std::uint8_t{0};
}

// The data bytes. There may be a '.' between two bytes.
void parse_bytes(Cursor& cursor, Frame& frame) {
  std::size_t size = 0;
  for (;;) {
    const std::string_view digits = cursor.run(is_hex);
    cursor.expect(digits.size() % 2 == 0, "two hex digits a byte");
    const bool fits = size + digits.size() / 2 <= Frame::max_size;
    if (!fits) cursor.back(digits.size());
    cursor.expect(fits, frame.fd ? "0-8, 12, 16, 20, 24, 32, 48 or 64 bytes" : "0 to 8 bytes");
    if (cursor.failed()) return;
    for (std::size_t i = 0; i < digits.size(); i += 2)
      frame.data[size++] = static_cast<std::uint8_t>(hex_value(digits[i]) << 4U | hex_value(digits[i + 1]));
    if (digits.empty() || !cursor.accept('.')) break;
  }
  const bool fits = size_has_dlc(static_cast<std::uint8_t>(size), frame.fd);
  if (!fits) cursor.back(2 * size);
  cursor.expect(fits, frame.fd ? "0-8, 12, 16, 20, 24, 32, 48 or 64 bytes" : "0 to 8 bytes");
  frame.size = static_cast<std::uint8_t>(size);
}

void parse_data(Cursor& cursor, LogEntry& entry) {
  Frame& frame = entry.frame;
  const auto one_hex = [first = true](char c) mutable { return std::exchange(first, false) && is_hex(c); };
  cursor.require('#', "'#' after the id");
  if (cursor.accept('#')) {
    const std::string_view flags = cursor.run(one_hex);
    cursor.expect(!flags.empty() && !frame.error,
                  frame.error ? "no FD error frame" : "a hex digit of FD flags");
    const unsigned value = flags.empty() ? 0 : hex_value(flags[0]);
    frame.fd = true;
    frame.brs = (value & flag_brs) != 0;
    frame.esi = (value & flag_esi) != 0;
  }
  if (!frame.fd && cursor.accept('R'))
    parse_request(cursor, entry);
  else
    parse_bytes(cursor, frame);
  // A data length code above 8, which `candump -8` writes.
  if (!frame.fd && cursor.accept('_'))
    cursor.expect(!cursor.run(one_hex).empty(), "a hex digit of a length code");
}

// True for a frame of CAN XL, such as "(1.000000) can0 00321#81:05:11223344#DEADBEEF".
bool is_xl(std::string_view line) {
  const std::size_t hash = line.find('#');
  return hash != std::string_view::npos && line.find(':', hash) < line.find('#', hash + 1) &&
         line.find('#', hash + 1) != std::string_view::npos;
}

// True if an id and a size such as [8] follow the first word of the line.
bool is_frame_without_time(std::string_view line) {
  logs::Words words;
  logs::split(line, words);
  return std::ranges::any_of(words, [](std::string_view word) {
    return word.size() >= 3 && word.front() == '[' && word.back() == ']' && is_digit(word[1]);
  });
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
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("#{:X}"),
                   flag_fd | (frame.brs ? flag_brs : 0) | (frame.esi ? flag_esi : 0));
  if (entry.remote) {
    line += 'R';
    if (frame.size > 0) line += static_cast<char>('0' + frame.size);
  } else {
    for (const std::uint8_t byte : frame.payload())
      fmt::format_to(std::back_inserter(line), FMT_COMPILE("{:02X}"), byte);
  }
  line += entry.transmitted ? " T" : " R";
  return line;
}

namespace {

// `where` is called for an error only.
template <class Where>
Result<LogEntry> parse_line(std::string_view line, const Where& where) {
  Cursor cursor(line);
  LogEntry entry;
  entry.t_ns = parse_time(cursor);
  entry.interface = cursor.run(is_name);
  cursor.expect(!entry.interface.empty(), "the interface's name");
  cursor.require(' ', "a space after the interface's name");
  parse_id(cursor, entry.frame);
  parse_data(cursor, entry);
  if (cursor.accept(' ')) {
    entry.transmitted = cursor.accept('T');
    cursor.expect(entry.transmitted || cursor.accept('R'), "'T' or 'R'");
  }
  cursor.expect(cursor.at_end(), "data as hex digits, then ' T', ' R' or the end of the line");
  if (cursor.failed()) return failure(cursor.complaint(where()));
  return entry;
}

}  // namespace

Result<LogEntry> parse_log_line(std::string_view line, std::string_view where) {
  return parse_line(line, [&] { return where; });
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
  explicit CandumpSource(Input input) : lines_(std::move(input)) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto line = lines_.next();
      if (!line) return tl::unexpected(line.error());
      if (!*line) return std::optional<LogEntry>();
      text_ = (*line)->text;
      auto parsed = parse(text_);
      if (!parsed) return tl::unexpected(parsed.error());
      // If the recording program was killed, the last line may end between two data bytes. Such a line must
      // not be read as a shorter frame.
      if (parsed->entry && !(*line)->ended)
        return failure(fmt::format("{}:{}: expected the end of the line: the log is cut", lines_.where(),
                                   text_.size() + 1));
      if (parsed->entry) return std::move(parsed->entry);
      if (!parsed->left_out.empty()) leave_out(parsed->left_out);
    }
  }
  [[nodiscard]] std::string last() const override { return fmt::format("{}: '{}'", lines_.where(), text_); }
  [[nodiscard]] bool recognised() const override { return recognised_; }

 private:
  Result<Parsed> parse(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t");
    if (start == std::string_view::npos) return Parsed{};
    if (text[start] == '\x1b') return coloured(text);
    if (text[start] != '(') {
      return Parsed{.left_out = is_frame_without_time(text)
                                    ? "frames without a time, expected the output of candump -L or -t a"
                                    : "lines that are not frames, such as comments"};
    }
    recognised_ = true;
    // On the screen, the data may follow as characters, which may contain '#'.
    const std::string_view before_data = text.substr(0, text.find('#'));
    if (before_data.find('[') != std::string_view::npos || before_data.find('{') != std::string_view::npos)
      return on_screen(text);
    if (is_xl(text)) return Parsed{.left_out = "frames of CAN XL"};
    auto entry = parse_line(text, [&] { return lines_.where(); });
    if (!entry) return tl::unexpected(entry.error());
    return Parsed{.entry = std::move(*entry)};
  }
  Result<Parsed> coloured(std::string_view text) {
    std::string plain = without_colours(text);
    if (plain.size() == text.size()) return Parsed{.left_out = "lines that are not frames, such as comments"};
    kept_ = std::move(plain);
    text_ = kept_;
    return parse(text_);
  }
  Result<Parsed> on_screen(std::string_view text) {
    if (text.find("\x1b[") != std::string_view::npos) return coloured(text);
    if (screen_.times() == ScreenTimes::unknown && ScreenParser::has_short_time(text)) {
      std::string copied = std::string(text) + '\n';  // looking ahead invalidates the line
      const auto following = lines_.following();
      if (!following) return tl::unexpected(following.error());
      screen_.decide_times(copied + without_colours(*following));
      text = text_ = kept_ = copied.substr(0, copied.size() - 1);
      const bool previous = screen_.times() == ScreenTimes::from_previous;
      remark(fmt::format("{}: times without a date are read as times since the {} frame (candump -t {})",
                         lines_.where(), previous ? "previous" : "first", previous ? 'd' : 'z'));
    }
    auto parsed = screen_.line(text);
    if (!parsed) return failure(fmt::format("{}: expected {}", lines_.where(), parsed.error().message));
    return parsed;
  }

  LineReader lines_;
  std::string_view text_;
  std::string kept_;
  ScreenParser screen_;
  bool recognised_ = false;
};

}  // namespace

std::unique_ptr<LogSink> candump_sink(File file) { return std::make_unique<CandumpSink>(std::move(file)); }

std::unique_ptr<LogSource> candump_source(Input input) {
  return std::make_unique<CandumpSource>(std::move(input));
}

}  // namespace logs
}  // namespace canhil
