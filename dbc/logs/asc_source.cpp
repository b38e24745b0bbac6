#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <span>
#include <string_view>
#include <vector>

#include "dbc/logs/asc.hpp"
#include "dbc/logs/formats.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same(std::string_view word, std::string_view lower_word) {
  return std::ranges::equal(word, lower_word, {}, lower);
}

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(blanks, end);
  }
  return words;
}

template <class Number>
std::optional<Number> number_of(std::string_view word, int base) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// Converts a time in seconds, such as "12.345678", to nanoseconds.
std::optional<std::int64_t> time_of(std::string_view word) {
  const std::size_t dot = word.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const auto seconds = number_of<std::uint32_t>(word.substr(0, dot), 10);
  std::string fraction(word.substr(dot + 1, 9));
  fraction.resize(9, '0');
  const auto ns = number_of<std::uint32_t>(fraction, 10);
  if (!seconds || !ns) return std::nullopt;
  return std::int64_t{*seconds} * ns_per_s + *ns;
}

// These limits ensure that the time of every event is below 2^63 ns. This time is the sum of the start of the
// log and the time since the start.
constexpr int last_year = 2200;
constexpr std::int64_t longest_ns = 1'000'000'000 * ns_per_s;

// Converts a date in local time to ns since 1970. Formats: "Tue Nov 24 08:12:13.500 2026" and "Tue Nov 24
// 08:12:13.500 am 2026".
std::optional<std::int64_t> date_of(std::span<const std::string_view> words) {
  constexpr std::array months{"jan", "feb", "mar", "apr", "may", "jun",
                              "jul", "aug", "sep", "oct", "nov", "dec"};
  const bool halves = words.size() == 6;
  if (words.size() != 5 && !halves) return std::nullopt;
  const auto month = std::ranges::find_if(months, [&](const char* name) { return same(words[1], name); });
  const auto day = number_of<int>(words[2], 10);
  const std::string_view clock = words[3];
  const auto year = number_of<int>(words.back(), 10);
  if (month == months.end() || !day || !year || clock.size() < 8 || clock[2] != ':' || clock[5] != ':')
    return std::nullopt;
  const auto hour = number_of<int>(clock.substr(0, 2), 10), minute = number_of<int>(clock.substr(3, 2), 10);
  const auto since = time_of(std::string(clock.substr(6)) + (clock.size() == 8 ? ".0" : ""));
  if (!hour || !minute || !since) return std::nullopt;
  // python-can 4.1 shortens microseconds to milliseconds: it deletes the last three digits. If these digits
  // also occur elsewhere in the date, it deletes them there too. So the year may be "2" instead of "2026".
  const auto within = [](int value, int least, int most) { return least <= value && value <= most; };
  if (!within(*year, 1970, last_year) || !within(*day, 1, 31) || !within(*hour, 0, 23) ||
      !within(*minute, 0, 59) || *since >= 61 * ns_per_s)
    return std::nullopt;
  std::tm when{};
  when.tm_year = *year - 1900;
  when.tm_mon = static_cast<int>(month - months.begin());
  when.tm_mday = *day;
  when.tm_hour = halves ? *hour % 12 + (same(words[4], "pm") ? 12 : 0) : *hour;
  when.tm_min = *minute;
  when.tm_isdst = -1;
  return std::mktime(&when) * ns_per_s + *since;
}

bool is_direction(std::string_view word) { return same(word, "rx") || same(word, "tx"); }

}  // namespace

std::optional<std::uint32_t> AscParser::number(std::string_view word) const {
  return number_of<std::uint32_t>(word, base_);
}

bool AscParser::read_id(std::string_view word, Frame& frame) const {
  frame.extended = word.ends_with('x') || word.ends_with('X');
  if (frame.extended) word.remove_suffix(1);
  const auto id = number(word);
  if (!id || *id > (frame.extended ? max_extended_id : max_standard_id)) return false;
  frame.id = *id;
  return true;
}

Result<void> AscParser::read_data(std::span<const std::string_view> words, std::size_t size,
                                  Frame& frame) const {
  if (words.size() < size) return failure(fmt::format("{} bytes of data", size));
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = number(words[i]);
    if (!byte || *byte > 0xFF) return failure(fmt::format("a byte in place of '{}'", words[i]));
    frame.data[i] = static_cast<std::uint8_t>(*byte);
  }
  frame.size = static_cast<std::uint8_t>(size);
  return {};
}

// The format of a classic frame: ID DIRECTION d DLC BYTES...
Result<void> AscParser::read_classic(std::span<const std::string_view> words, LogEntry& entry) const {
  const auto dlc = words.size() > 3 ? number_of<std::size_t>(words[3], 16) : std::nullopt;
  if (!read_id(words[0], entry.frame)) return failure("an id");
  if (!dlc || *dlc > 15) return failure("a data length code");
  entry.transmitted = same(words[1], "tx");
  return read_data(words.subspan(4), std::min<std::size_t>(*dlc, 8), entry.frame);
}

// The format of an FD frame: DIRECTION ID [NAME] BRS ESI DLC SIZE BYTES...
Result<void> AscParser::read_fd(std::span<const std::string_view> words, LogEntry& entry) const {
  entry.transmitted = same(words[0], "tx");
  if (!read_id(words[1], entry.frame)) return failure("an id");
  const auto is_flag = [](std::string_view word) { return word == "0" || word == "1"; };
  std::size_t at = 2;
  if (words.size() > at + 1 && !(is_flag(words[at]) && is_flag(words[at + 1]))) ++at;
  const auto size = words.size() > at + 3 ? number_of<std::size_t>(words[at + 3], 10) : std::nullopt;
  if (!size || !is_flag(words[at]) || !is_flag(words[at + 1]))
    return failure("BRS, ESI, data length code and size");
  if (*size > Frame::max_size || dlc_of(static_cast<std::uint8_t>(*size)) == size_of_dlc.size())
    return failure("0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  entry.frame.fd = true;
  entry.frame.brs = words[at] == "1";
  return read_data(words.subspan(at + 4), *size, entry.frame);
}

std::string AscParser::interface_of(unsigned channel) const {
  const auto named = names_.find(channel);
  return named == names_.end() ? fmt::format("can{}", channel == 0 ? 0 : channel - 1) : named->second;
}

Result<std::optional<LogEntry>> AscParser::event(const std::vector<std::string_view>& words) {
  const bool fd = same(words[1], "canfd");
  const auto channel = words.size() > 3 || (words.size() > 2 && !fd)
                           ? number_of<unsigned>(words[fd ? 2 : 1], 10)
                           : std::nullopt;
  if (!channel) return std::optional<LogEntry>();  // not a frame, such as "Start of measurement"
  const std::span<const std::string_view> rest(words.begin() + (fd ? 3 : 2), words.end());
  LogEntry entry{.t_ns = start_ns_ + last_ns_, .interface = interface_of(*channel), .frame = {}};
  const std::size_t first = fd && is_direction(rest[0]) ? 1 : 0;
  if (rest.size() > first && same(rest[first], "errorframe")) {
    constexpr std::uint32_t bus_error = 0x80;  // CAN_ERR_BUSERROR; the format has no details of the error
    entry.frame = {.id = bus_error, .size = 8, .error = true};
    return std::optional(std::move(entry));
  }
  if (rest.size() < 3 || !is_direction(rest[fd ? 0 : 1]))
    return std::optional<LogEntry>();  // not a frame, such as "Statistic: ..."
  if (!fd && same(rest[2], "r")) return std::optional<LogEntry>();
  if (!fd && !same(rest[2], "d")) return failure("'d' or 'r' after the direction");
  if (auto read = fd ? read_fd(rest, entry) : read_classic(rest, entry); !read)
    return tl::unexpected(read.error());
  return std::optional(std::move(entry));
}

// Reads a line of the header; false: the line does not belong to the header.
bool AscParser::header(std::string_view text, const std::vector<std::string_view>& words) {
  constexpr std::string_view channel = "// channel ";
  if (text.starts_with(channel)) {
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) return true;
    if (const auto number = number_of<unsigned>(text.substr(channel.size(), colon - channel.size()), 10))
      names_[*number] = text.substr(colon + 2);
    return true;
  }
  if (words[0].starts_with("//")) return true;
  if (same(words[0], "base")) {
    base_ = words.size() > 1 && same(words[1], "dec") ? 10 : 16;
    relative_ = words.size() > 3 && same(words[3], "relative");
    return true;
  }
  const std::size_t before = same(words[0], "date") ? 1
                             : same(words[0], "begin") && words.size() > 1 && same(words[1], "triggerblock")
                                 ? 2
                                 : 0;
  if (before == 0) return false;
  if (const auto date = date_of(std::span(words).subspan(before))) start_ns_ = *date;
  last_ns_ = 0;
  return true;
}

Result<std::optional<LogEntry>> AscParser::line(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.empty() || header(text, words) || words.size() < 2) return std::optional<LogEntry>();
  const auto t_ns = time_of(words[0]);
  if (!t_ns) return std::optional<LogEntry>();
  last_ns_ = relative_ ? last_ns_ + *t_ns : *t_ns;
  if (last_ns_ > longest_ns) {
    last_ns_ = 0;
    return failure("a time of at most 1e9 s");
  }
  return event(words);
}

namespace {

class AscSource final : public LogSource {
 public:
  explicit AscSource(const std::string& path) : lines_(path) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto line = lines_.next();
      if (!line) return tl::unexpected(line.error());
      if (!*line) return std::optional<LogEntry>();
      auto entry = parser_.line((*line)->text);
      if (!entry) return failure(fmt::format("{}: expected {}", lines_.where(), entry.error().message));
      if (*entry) return entry;
    }
  }

 private:
  LineReader lines_;
  AscParser parser_;
};

}  // namespace

std::unique_ptr<LogSource> asc_source(const std::string& path) { return std::make_unique<AscSource>(path); }

}  // namespace canhil::logs
