#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/logs/asc_date.hpp"
#include "dbc/logs/line_source.hpp"
#include "dbc/logs/local_time.hpp"
#include "dbc/logs/trc.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::int64_t offset_unit_ns = 1'000'000;
constexpr std::int64_t largest_offset_ns = 1'000'000'000 * ns_per_s;

struct Version {
  std::string_view name;
  std::string_view columns;
};
// In versions 1.x, 'd' is Rx, Tx, Warng or Error.
constexpr std::array versions{Version{"1.0", "NOIlD"}, Version{"1.1", "NOdIlD"}, Version{"1.2", "NOBdIlD"},
                              Version{"1.3", "NOBdIRlD"}};

// The start time: days since 1899-12-30, in local time.
std::optional<std::int64_t> start_of(std::string_view days) {
  constexpr std::int64_t s_per_day = 86'400, first_day = 25'569;  // 1970-01-01
  constexpr std::int64_t last_day = 109'938;                      // 2200-12-31
  const std::size_t point = std::min(days.find_first_of(".,"), days.size());
  const auto day = number_of<std::int64_t>(days.substr(0, point));
  if (!day || *day < first_day || *day > last_day) return std::nullopt;
  constexpr std::int64_t resolution = 1'000'000'000'000;
  const auto part = time_of("0" + std::string(days.substr(point)), resolution);  // of the day
  if (!part) return std::nullopt;
  constexpr std::int64_t us_per_s = 1'000'000;
  const std::int64_t us = *part * s_per_day / (resolution / us_per_s);
  const std::time_t local_s = (*day - first_day) * s_per_day + us / us_per_s;
  std::tm when{};
  ::gmtime_r(&local_s, &when);
  return since_1970_s(when) * ns_per_s + us % us_per_s * 1000;
}

}  // namespace

Result<Parsed> TrcParser::comment(std::string_view text) {
  text.remove_prefix(1);
  const auto value_of = [&](std::string_view key) -> std::optional<std::string_view> {
    if (!text.starts_with(key)) return std::nullopt;
    std::string_view value = text.substr(key.size());
    while (value.ends_with(' ') || value.ends_with(';')) value.remove_suffix(1);
    return value;
  };
  if (const auto version = value_of("$FILEVERSION=")) {
    recognised_ = true;
    const auto known = std::ranges::find(versions, *version, &Version::name);
    if (known != versions.end()) {
      columns_ = known->columns;
    } else if (version->starts_with("2.")) {
      major_ = 2;
    } else {
      return failure("version 1.0 to 1.3 or 2.x in $FILEVERSION");
    }
  } else if (const auto columns = value_of("$COLUMNS=")) {
    columns_.clear();
    for (const char c : *columns) {
      if (c != ',') columns_ += c;
    }
    for (const char needed : std::string_view("NOTId")) {
      if (columns_.find(needed) == std::string::npos)
        return failure(fmt::format("a column {} in $COLUMNS", needed));
    }
    if (columns_.find_first_of("lL") == std::string::npos || !columns_.ends_with('D'))
      return failure("a column l or L, and the last column D, in $COLUMNS");
  } else if (const auto start = value_of("$STARTTIME=")) {
    const auto start_ns = start_of(*start);
    if (!start_ns) return Parsed{.left_out = "start times that are not understood; times count from 1970"};
    start_ns_ = *start_ns;
  } else if (const std::size_t at = text.find("Start time: ");
             at != std::string_view::npos && major_ == 1 && start_ns_ == 0) {
    Words words;  // version 1.0: "11.09.2002 14:07:41.985", with a further point before microseconds
    split(text.substr(at + 12), words);
    if (words.size() == 2) words[1] = words[1].substr(0, 12);
    if (const auto start_ns = date_of(words)) start_ns_ = *start_ns;
  }
  return Parsed{};
}

std::string_view TrcParser::word(char column) const {
  const std::size_t at = columns_.find(column);
  return at < words_.size() ? words_[at] : std::string_view{};
}

Result<Parsed> TrcParser::line(std::string_view text) {
  split(text, words_);
  if (words_.empty()) return Parsed{};
  if (words_[0].starts_with(';')) return comment(text.substr(text.find(';')));
  return event();
}

Result<Parsed> TrcParser::event() {
  std::string_view number = words_[0];
  if (number.ends_with(')')) number.remove_suffix(1);
  if (!number_of<std::uint64_t>(number)) return Parsed{.left_out = "lines that are not events"};
  if (major_ == 2 && columns_.find('T') == std::string::npos) return failure("$COLUMNS in the header");
  const auto offset_ns = time_of(word('O'), offset_unit_ns);
  if (!offset_ns || *offset_ns > largest_offset_ns) return failure("a time in ms, up to 1e12");
  LogEntry entry{.t_ns = start_ns_ + *offset_ns, .interface = "can0", .frame = {}};
  // Records of types other than frames have no id, so their further columns are at other places.
  const std::string_view type = major_ == 2 ? word('T') : word('d');
  if (type == "ER" || same(type, "error") || (major_ == 1 && word('D') == "ERROR")) {
    constexpr std::uint32_t bus_error = 0x80;  // CAN_ERR_BUSERROR
    entry.frame = {.id = bus_error, .size = 8, .error = true};
    recognised_ = true;
    return Parsed{.entry = std::move(entry)};
  }
  if (same(type, "warng") || type == "ST" || type == "EC" || type == "EV" ||
      (major_ == 1 && word('I') == "FFFFFFFF"))
    return Parsed{.left_out = "records of the status of the bus"};
  constexpr std::array<std::string_view, 6> frames{"DT", "FD", "FB", "FE", "BI", "RR"};
  if (major_ == 2 && std::ranges::find(frames, type) == frames.end())
    return Parsed{.left_out = "records of an unknown type"};
  return frame(std::move(entry), type);
}

Result<Parsed> TrcParser::frame(LogEntry entry, std::string_view type) {
  Frame& frame = entry.frame;
  const std::string_view id_word = word('I');
  const auto id = number_of<std::uint32_t>(id_word, 16);
  frame.extended = id_word.size() > 4;
  if (!id || *id > (frame.extended ? max_extended_id : max_standard_id))
    return failure("an id of 4 hex digits up to 07FF, or 8 up to 1FFFFFFF");
  frame.id = *id;
  if (columns_.find('d') != std::string::npos) {
    entry.transmitted = same(word('d'), "tx");
    if (!entry.transmitted && !same(word('d'), "rx")) return failure("Rx or Tx");
  }
  if (const auto bus = number_of<unsigned>(word('B')); bus && columns_.find('B') != std::string::npos)
    entry.interface = fmt::format("can{}", *bus == 0 ? 0 : *bus - 1);
  if (major_ == 2) {
    frame.brs = type == "FB" || type == "BI";
    frame.esi = type == "FE" || type == "BI";
    frame.fd = type == "FD" || frame.brs || frame.esi;
    entry.remote = type == "RR";
  }
  const bool coded = columns_.find('L') != std::string::npos;
  const auto length = number_of<std::uint8_t>(word(coded ? 'L' : 'l'));
  if (!length || (coded && *length > 15)) return failure("the number of data bytes");
  frame.size = !coded ? *length : frame.fd ? size_of_dlc[*length] : std::min<std::uint8_t>(*length, 8);
  const std::size_t first = columns_.find('D');
  entry.remote = entry.remote || (words_.size() > first && same(words_[first], "rtr"));
  if (!can_carry(frame, true)) return failure("the number of data bytes of a frame of CAN or CAN FD");
  recognised_ = true;
  if (entry.remote) return Parsed{.entry = std::move(entry)};
  if (words_.size() < first + frame.size) return failure(fmt::format("{} bytes of data", frame.size));
  for (std::size_t i = 0; i < frame.size; ++i) {
    const auto byte = number_of<std::uint8_t>(words_[first + i], 16);
    if (!byte) return failure(fmt::format("a byte in place of '{}'", words_[first + i]));
    frame.data[i] = *byte;
  }
  return Parsed{.entry = std::move(entry)};
}

std::unique_ptr<LogSource> trc_source(Input input) {
  return std::make_unique<LineSource<TrcParser>>(std::move(input));
}

}  // namespace canhil::logs
