// Detects the format of a log from its content.
#include <algorithm>
#include <array>

#include "dbc/logs/foreign.hpp"
#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {
namespace {

using namespace std::string_view_literals;

// The first bytes of captures: pcap with stamps in microseconds (little-endian, big-endian); pcap with stamps
// in nanoseconds (little-endian, big-endian); pcapng.
constexpr std::array captures{"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                              "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv};

bool begins_with(std::string_view text, std::string_view lower_word) {
  return same(text.substr(0, lower_word.size()), lower_word);
}

// The header of an ASC log begins with a comment, the date or the number base. Without the header, it begins
// with the time of an event.
bool is_asc(std::string_view text) {
  if (begins_with(text, "date ") || begins_with(text, "base ") || text.starts_with("//")) return true;
  const std::string_view number = text.substr(0, text.find_first_of(" \t"));
  return number.size() < text.size() && number.find_first_of(".,") != std::string_view::npos &&
         time_of(number).has_value();
}

// A TRC log begins with comments. Without them, it begins with the number of a message, such as "1)".
bool is_trc(std::string_view text) {
  if (text.starts_with(';')) return true;
  const std::size_t after = text.find_first_not_of("0123456789");
  return after != std::string_view::npos && after > 0 && text[after] == ')';
}

// The header of SavvyCAN's CSV has these columns, in any order.
constexpr std::size_t longest_csv_header = 512;
bool is_csv(std::string_view text) {
  std::string line(text.substr(0, text.find_first_of("\r\n")));
  std::ranges::transform(line, line.begin(), lower);
  line = ',' + line + ',';
  return std::ranges::all_of(std::array{",time stamp,"sv, ",id,"sv, ",extended,"sv, ",bus,"sv},
                             [&](std::string_view column) { return line.find(column) != std::string::npos; });
}

// The first bytes, or the first line if it is shorter: a reader of a pipe must not wait for a second line.
Result<std::string_view> beginning_of(Input& input, std::size_t size) {
  constexpr std::size_t longest_magic = 4;
  for (std::size_t most = longest_magic; most < size; ++most) {
    auto text = input.peek(most);
    if (!text || text->size() < most || text->find('\n') != std::string_view::npos) return text;
  }
  return input.peek(size);
}

}  // namespace

Result<std::unique_ptr<LogSource>> source_of(Input input) {
  const auto beginning = beginning_of(input, beginning_size);
  if (!beginning) return tl::unexpected(beginning.error());
  if (std::ranges::any_of(captures, [&](std::string_view magic) { return beginning->starts_with(magic); }))
    return capture_source(std::move(input));
  if (beginning->starts_with("LOGG")) return blf_source(std::move(input));
  if (auto foreign = foreign_format(*beginning, input.name())) return failure(std::move(*foreign));
  const std::size_t start = std::min(beginning->find_first_not_of(" \t\r\n"), beginning->size());
  const std::string_view text = beginning->substr(start);
  if (is_trc(text)) return trc_source(std::move(input));
  if (begins_with(text, "time stamp,")) return csv_source(std::move(input));
  if (is_asc(text)) return asc_source(std::move(input));
  if (text.find(',') == std::string_view::npos) return candump_source(std::move(input));
  const auto header = beginning_of(input, longest_csv_header);
  if (!header) return tl::unexpected(header.error());
  return is_csv(*header) ? csv_source(std::move(input)) : candump_source(std::move(input));
}

}  // namespace canhil::logs
