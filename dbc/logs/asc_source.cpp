#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "dbc/logs/asc.hpp"
#include "dbc/logs/asc_date.hpp"
#include "dbc/logs/line_source.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::int64_t longest_ns = 1'000'000'000 * ns_per_s;
constexpr unsigned last_channel = 255;

constexpr std::string_view other_event = "events other than frames of CAN";

bool is_direction(std::string_view word) { return same(word, "rx") || same(word, "tx"); }

}  // namespace

std::optional<std::uint32_t> AscParser::number(std::string_view word) const {
  return number_of<std::uint32_t>(word, base_);
}

// False for the name of a message, which a log in symbolic form has in place of the id.
bool AscParser::is_id(std::string_view word) const {
  if (word.ends_with('x') || word.ends_with('X')) word.remove_suffix(1);
  return number(word).has_value();
}

bool AscParser::read_id(std::string_view word, Frame& frame) const {
  frame.extended = word.ends_with('x') || word.ends_with('X');
  if (frame.extended) word.remove_suffix(1);
  const auto id = number(word);
  if (!id || *id > (frame.extended ? max_extended_id : max_standard_id)) return false;
  frame.id = *id;
  return true;
}

Result<void> AscParser::read_data(Rest words, std::size_t size, Frame& frame) const {
  if (words.size() < size) return failure(fmt::format("{} bytes of data", size));
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = number(words[i]);
    if (!byte || *byte > 0xFF) return failure(fmt::format("a byte in place of '{}'", words[i]));
    frame.data[i] = static_cast<std::uint8_t>(*byte);
  }
  frame.size = static_cast<std::uint8_t>(size);
  return {};
}

// The format of a classic frame: ID DIRECTION d DLC BYTES... or ID DIRECTION r [DLC]
Result<Parsed> AscParser::classic(Rest words, LogEntry entry) const {
  if (same(words[0], "statistic:")) return Parsed{.left_out = "bus statistics"};
  if (words.size() > 1 && same(words[1], "txrq")) return Parsed{.left_out = "requests to send (TxRq)"};
  if (words.size() < 3 || !is_direction(words[1])) return Parsed{.left_out = other_event};
  if (!is_id(words[0])) return Parsed{.left_out = "frames with a name in place of the id"};
  if (!read_id(words[0], entry.frame)) return failure("an id");
  entry.transmitted = same(words[1], "tx");
  constexpr std::uint8_t none = 255, last_code = 15;
  const std::uint8_t code = words.size() > 3 ? number_of<std::uint8_t>(words[3], 16).value_or(none) : none;
  entry.remote = same(words[2], "r");
  if (entry.remote) {  // the length code may be missing
    entry.frame.size = code == none ? std::uint8_t{0} : std::min<std::uint8_t>(code, 8);
    return Parsed{.entry = std::move(entry)};
  }
  if (!same(words[2], "d")) return failure("'d' or 'r' after the direction");
  // Old versions of python-can write a frame of CAN FD like this, with its size in place of the length code.
  entry.frame.fd = code > last_code && code <= Frame::max_size && size_has_dlc(code, true);
  if (code > last_code && !entry.frame.fd) return failure("a data length code");
  const std::size_t size = entry.frame.fd ? code : std::min<std::size_t>(code, 8);
  if (auto read = read_data(words.subspan(4), size, entry.frame); !read) return tl::unexpected(read.error());
  return Parsed{.entry = std::move(entry)};
}

// Finds the columns BRS ESI DLC SIZE after a name, which may have blanks.
AscParser::FdColumns AscParser::after_name(Rest words) {
  constexpr std::size_t most_words_of_name = 8;
  const auto is_flag = [](std::string_view word) { return word == "0" || word == "1"; };
  for (std::size_t at = 0; at <= most_words_of_name && at + 3 < words.size(); ++at) {
    if (!is_flag(words[at]) || !is_flag(words[at + 1])) continue;
    const auto dlc = number_of<std::size_t>(words[at + 2], 16), size = number_of<std::size_t>(words[at + 3]);
    if (dlc && size) return {at, dlc, size};
  }
  return {};
}

// DIRECTION ID [NAME] BRS ESI DLC SIZE BYTES... DURATION LENGTH FLAGS... The flags state whether the frame is
// one of CAN FD: tools write classic frames in this form too. Without flags it is one of CAN FD.
Result<void> AscParser::read_fd(Rest words, LogEntry& entry) const {
  Frame& frame = entry.frame;
  entry.transmitted = same(words[0], "tx");
  if (!read_id(words[1], frame)) return failure("an id");
  const auto [flags_at, dlc, size] = after_name(words.subspan(2));
  if (!size || !dlc) return failure("BRS, ESI, data length code and size");
  const Rest columns = words.subspan(2 + flags_at);
  frame.fd = true;
  frame.brs = columns[0] == "1";
  frame.esi = columns[1] == "1";
  const Rest data = columns.subspan(4);
  if (data.size() > *size + 2) {
    const auto flags = number_of<std::uint32_t>(data[*size + 2], 16);
    const bool classic = flags && (*flags & AscFdFlags::fd) == 0 && *size <= 8;
    if (classic) frame.fd = frame.brs = frame.esi = false;
    entry.remote = classic && (*flags & AscFdFlags::remote) != 0;
  }
  if (entry.remote) {
    frame.size = static_cast<std::uint8_t>(std::min<std::size_t>(*dlc, 8));
    return {};
  }
  if (*size > Frame::max_size || !size_has_dlc(static_cast<std::uint8_t>(*size), true))
    return failure("0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  return read_data(data, *size, frame);
}

// The columns that CANoe wrote before version 8: ID [NAME] DIRECTION BRS ESI d DLC SIZE BYTES...
Result<void> AscParser::read_fd_of_old_tools(Rest words, LogEntry& entry) const {
  if (!read_id(words[0], entry.frame)) return failure("an id");
  const Rest rest = words.subspan(is_direction(words[1]) ? 1 : 2);
  entry.transmitted = same(rest[0], "tx");
  const auto dlc = rest.size() > 5 ? number_of<std::size_t>(rest[4], 16) : std::nullopt;
  const auto size = rest.size() > 5 ? number_of<std::size_t>(rest[5]) : std::nullopt;
  if (!dlc || !size) return failure("BRS, ESI, d, data length code and size");
  entry.remote = same(rest[3], "r");
  if (entry.remote) {
    entry.frame.size = static_cast<std::uint8_t>(std::min<std::size_t>(*dlc, 8));
    return {};
  }
  entry.frame.brs = rest[1] == "1";
  entry.frame.esi = rest[2] == "1";
  entry.frame.fd = true;
  if (*size > Frame::max_size || !size_has_dlc(static_cast<std::uint8_t>(*size), true))
    return failure("0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  return read_data(rest.subspan(6), *size, entry.frame);
}

Result<Parsed> AscParser::fd(Rest words, LogEntry entry) const {
  const bool is_new = is_direction(words[0]);
  const bool is_old = words.size() > 2 && (is_direction(words[1]) || is_direction(words[2]));
  if (words.size() < 3 || (!is_new && !is_old))
    return Parsed{.left_out = same(words[0], "txrq") ? "requests to send (TxRq)" : other_event};
  if (!is_id(words[is_new ? 1 : 0])) return Parsed{.left_out = "frames with a name in place of the id"};
  if (auto read = is_new ? read_fd(words, entry) : read_fd_of_old_tools(words, entry); !read)
    return tl::unexpected(read.error());
  return Parsed{.entry = std::move(entry)};
}

const std::string& AscParser::interface_of(unsigned channel) {
  const auto named = names_.find(channel);
  if (named != names_.end()) return named->second;
  return names_.emplace(channel, fmt::format("can{}", channel == 0 ? 0 : channel - 1)).first->second;
}

Result<Parsed> AscParser::event() {
  const Rest words(words_);
  if (same(words[1], "canxl")) return Parsed{.left_out = "frames of CAN XL"};
  const bool is_fd = same(words[1], "canfd");
  const std::size_t at = is_fd ? 2 : 1;  // the channel
  const auto channel = words.size() > at + 1 ? number_of<unsigned>(words[at]) : std::nullopt;
  if (!channel || *channel > last_channel) {
    const bool of_the_log = same(words[1], "start") || same(words[1], "log");
    return Parsed{.left_out = of_the_log ? std::string_view{} : other_event};
  }
  const Rest rest = words.subspan(at + 1);
  LogEntry entry{.t_ns = start_ns_ + last_ns_, .interface = interface_of(*channel), .frame = {}};
  const std::size_t first = is_fd && is_direction(rest[0]) ? 1 : 0;
  if (rest.size() > first && same(rest[first], "errorframe")) {
    constexpr std::uint32_t bus_error = 0x80;  // CAN_ERR_BUSERROR; the format has no details of the error
    entry.transmitted = first == 1 && same(rest[0], "tx");
    entry.frame = {.id = bus_error, .size = 8, .error = true};
    return Parsed{.entry = std::move(entry)};
  }
  auto parsed = is_fd ? fd(rest, std::move(entry)) : classic(rest, std::move(entry));
  recognised_ = recognised_ || (parsed && parsed->entry);
  return parsed;
}

// Reads a line of the header; nullopt: the line does not belong to the header.
std::optional<Parsed> AscParser::header(std::string_view text) {
  constexpr std::string_view channel = "// channel ";
  if (text.starts_with(channel)) {
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) return Parsed{};
    const auto number = number_of<unsigned>(text.substr(channel.size(), colon - channel.size()));
    if (number && *number <= last_channel && colon + 2 < text.size())
      names_[*number] = interface_name(text.substr(colon + 2));
    return Parsed{};
  }
  const std::string_view first = words_[0];
  if (first.starts_with("//")) return Parsed{};
  const bool two = words_.size() > 1;
  if (same(first, "base")) {
    recognised_ = true;
    base_ = two && same(words_[1], "dec") ? 10 : 16;
    relative_ = words_.size() > 3 && same(words_[3], "relative");
    return Parsed{};
  }
  if (same(first, "internal") || (same(first, "no") && two && same(words_[1], "internal")) ||
      (same(first, "end") && two && same(words_[1], "triggerblock")) ||
      (same(first, "previous") && two && same(words_[1], "log")))
    return Parsed{};
  const std::size_t before = same(first, "date")                                              ? 1
                             : same(first, "begin") && two && same(words_[1], "triggerblock") ? 2
                                                                                              : 0;
  if (before == 0) return std::nullopt;
  recognised_ = true;
  last_ns_ = 0;
  if (words_.size() == before) return Parsed{};
  const auto date = date_of(Rest(words_).subspan(before));
  if (!date)
    return Parsed{.left_out = "dates that are not understood; times count from 1970 or the last date"};
  start_ns_ = *date;
  return Parsed{};
}

Result<Parsed> AscParser::line(std::string_view text) {
  split(text, words_);
  if (words_.empty()) return Parsed{};
  if (auto read = header(text)) return std::move(*read);
  const auto t_ns =
      words_[0].find_first_of(".,") == std::string_view::npos ? std::nullopt : time_of(words_[0]);
  if (!t_ns || words_.size() < 2) return Parsed{.left_out = "lines that are not events"};
  if (*t_ns > longest_ns || (relative_ ? last_ns_ + *t_ns : *t_ns) > longest_ns) {
    last_ns_ = 0;
    return failure("a time of at most 1e9 s");
  }
  last_ns_ = relative_ ? last_ns_ + *t_ns : *t_ns;
  return event();
}

std::unique_ptr<LogSource> asc_source(Input input) {
  return std::make_unique<LineSource<AscParser>>(std::move(input));
}

}  // namespace canhil::logs
