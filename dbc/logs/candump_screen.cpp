#include "dbc/logs/candump_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "dbc/logs/local_time.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::size_t short_seconds = 9;  // a time since 1970 has ten digits before the point, at least

// The text between the parentheses at the beginning of a line.
std::string_view stamp_of(std::string_view text) {
  const std::size_t open = text.find_first_not_of(" \t");
  if (open == std::string_view::npos || text[open] != '(') return {};
  const std::size_t close = text.find(')', open);
  return close == std::string_view::npos ? std::string_view{} : text.substr(open + 1, close - open - 1);
}

// A local date and time: "2015-07-10" and "08:10:52.249713".
std::optional<std::int64_t> local_date(std::string_view date, std::string_view clock) {
  if (date.size() != 10 || date[4] != '-' || date[7] != '-' || clock.size() < 8 || clock[2] != ':' ||
      clock[5] != ':')
    return std::nullopt;
  const auto year = number_of<int>(date.substr(0, 4)), month = number_of<int>(date.substr(5, 2)),
             day = number_of<int>(date.substr(8)), hour = number_of<int>(clock.substr(0, 2)),
             minute = number_of<int>(clock.substr(3, 2));
  const auto second_ns = time_of(clock.substr(6));
  if (!year || !month || !day || !hour || !minute || !second_ns) return std::nullopt;
  const auto within = [](int value, int least, int most) { return least <= value && value <= most; };
  if (!within(*year, 1970, 2200) || !within(*month, 1, 12) || !within(*day, 1, 31) || !within(*hour, 0, 23) ||
      !within(*minute, 0, 59) || *second_ns >= 61 * ns_per_s)
    return std::nullopt;
  std::tm when{};
  when.tm_year = *year - 1900;
  when.tm_mon = *month - 1;
  when.tm_mday = *day;
  when.tm_hour = *hour;
  when.tm_min = *minute;
  return since_1970_s(when) * ns_per_s + *second_ns;
}

}  // namespace

std::string without_colours(std::string_view text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.substr(at).starts_with("\x1b["))
      at = std::min(text.find_first_not_of("0123456789;", at + 2), text.size());  // the letter after them
    else
      plain += text[at];
  }
  return plain;
}

bool ScreenParser::has_short_time(std::string_view text) {
  const std::string_view stamp = stamp_of(text);
  return stamp.find('.') <= short_seconds && time_of(stamp).has_value();
}

void ScreenParser::decide_times(std::string_view lines) {
  std::int64_t last_ns = -1, same_ns = -1;
  std::size_t count = 0;
  bool falls = false, equal = true;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    if (end == std::string_view::npos) break;
    const std::string_view line = lines.substr(0, end);
    lines.remove_prefix(end + 1);
    const auto t_ns = has_short_time(line) ? time_of(stamp_of(line)) : std::nullopt;
    if (!t_ns) continue;
    falls = falls || *t_ns < last_ns;
    last_ns = *t_ns;
    if (++count == 2) same_ns = *t_ns;
    equal = equal && (count < 2 || *t_ns == same_ns);
  }
  times_ =
      falls || (equal && count > 2 && same_ns > 0) ? ScreenTimes::from_previous : ScreenTimes::from_first;
}

std::optional<std::int64_t> ScreenParser::read_time() {
  std::string_view first = words_[0];
  if (!first.starts_with('(')) return std::nullopt;
  first.remove_prefix(1);
  if (!first.ends_with(')')) {  // a date, whose clock is the next word
    if (words_.size() < 2 || !words_[1].ends_with(')')) return std::nullopt;
    at_ = 2;
    return local_date(first, words_[1].substr(0, words_[1].size() - 1));
  }
  at_ = 1;
  first.remove_suffix(1);
  const auto t_ns = time_of(first);
  if (!t_ns || first.find('.') > short_seconds || times_ != ScreenTimes::from_previous) return t_ns;
  last_ns_ += *t_ns;
  return last_ns_;
}

Result<Parsed> ScreenParser::line(std::string_view text) {
  split(text, words_);
  LogEntry entry;
  const auto t_ns = read_time();
  if (!t_ns) return failure("the time of candump in parentheses");
  entry.t_ns = *t_ns;
  if (at_ >= words_.size()) return failure("the interface's name after the time");
  entry.interface = interface_name(words_[at_++]);
  return frame(std::move(entry));
}

Result<Parsed> ScreenParser::frame(LogEntry entry) {
  Frame& frame = entry.frame;
  if (at_ + 3 <= words_.size() && (words_[at_] == "RX" || words_[at_] == "TX")) {
    entry.transmitted = words_[at_] == "TX";
    frame.brs = words_[at_ + 1] == "B";
    frame.esi = words_[at_ + 2] == "E";
    at_ += 3;
  }
  if (at_ + 2 > words_.size()) return failure("an id and a size such as [8]");
  const std::string_view id_word = words_[at_], size_word = words_[at_ + 1];
  at_ += 2;
  const auto id = number_of<std::uint32_t>(id_word, 16);
  constexpr std::uint32_t error_flag = 0x2000'0000;
  frame.error = id && id_word.size() == 8 && (*id & ~max_extended_id) == error_flag;
  frame.extended = id && id_word.size() == 8 && !frame.error;
  if (!id || (id_word.size() != 3 && id_word.size() != 8) ||
      (*id > (frame.extended ? max_extended_id : max_standard_id) && !frame.error))
    return failure("an id of 3 hex digits up to 7FF, or 8 up to 1FFFFFFF");
  frame.id = *id & max_extended_id;
  if (size_word.size() == 6) return Parsed{.left_out = "frames of CAN XL"};
  const bool raw = size_word.size() == 3 && size_word.front() == '{' && size_word.back() == '}';
  const bool bytes =
      (size_word.size() == 3 || size_word.size() == 4) && size_word.front() == '[' && size_word.back() == ']';
  const auto size = raw || bytes
                        ? number_of<std::uint8_t>(size_word.substr(1, size_word.size() - 2), raw ? 16 : 10)
                        : std::nullopt;
  frame.fd = size_word.size() == 4;
  frame.brs = frame.brs && frame.fd;
  frame.esi = frame.esi && frame.fd;
  if (!size || *size > Frame::max_size) return failure("a size such as [8]");
  frame.size = raw ? std::min<std::uint8_t>(*size, 8) : *size;
  if (!can_carry(frame, true)) return failure("a size of a frame of CAN or CAN FD");
  if (!frame.fd && at_ < words_.size() && words_[at_] == "remote") {
    entry.remote = true;
    return Parsed{.entry = std::move(entry)};
  }
  if (auto read = read_bytes(frame); !read) return tl::unexpected(read.error());
  return Parsed{.entry = std::move(entry)};
}

Result<void> ScreenParser::read_bytes(Frame& frame) const {
  constexpr char swap_mark = '`';
  Words swapped;
  std::span<const std::string_view> bytes = std::span(words_).subspan(at_);
  if (!bytes.empty() && bytes[0].find(swap_mark) != std::string_view::npos) {
    split(bytes[0], swapped, swap_mark);
    std::ranges::reverse(swapped);
    bytes = swapped;
  }
  if (bytes.size() < frame.size) return failure(fmt::format("{} bytes of data", frame.size));
  for (std::size_t i = 0; i < frame.size; ++i) {
    const bool is_binary = bytes[i].size() == 8;
    const auto byte = bytes[i].size() == 2 || is_binary
                          ? number_of<std::uint8_t>(bytes[i], is_binary ? 2 : 16)
                          : std::nullopt;
    if (!byte) return failure(fmt::format("a byte in place of '{}'", bytes[i]));
    frame.data[i] = *byte;
  }
  return {};
}

}  // namespace canhil::logs
