#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>

#include "dbc/show/show.hpp"
#include "dbc/show/table.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::dbc {
namespace {

/// The number of characters in a UTF-8 text.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string aligned(std::vector<Row> rows) {
  for (Row& row : rows)
    std::ranges::transform(row, row.begin(), [](const std::string& cell) { return one_line(cell); });
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width_of(row[i]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string id_text(const Message& message) {
  return message.extended ? fmt::format("0x{:08X}", message.id) : fmt::format("0x{:03X}", message.id);
}

std::string cycle_text(const Message& message) {
  if (message.cycle_time_us == 0) return "-";
  return fmt::format("{} ms", static_cast<double>(message.cycle_time_us) / 1000);
}

std::string sender_text(const Message& message) {
  std::string text = message.sender;
  for (const std::string& sender : message.further_senders) text += (text.empty() ? "" : ", ") + sender;
  return text.empty() ? "-" : text;
}

std::string message_table(const Database& database) {
  std::vector<Row> rows{{"id", "message", "bytes", "cycle", "sender", "signals"}};
  for (const Message& message : database.messages) {
    std::string signals;
    for (const Signal& signal : message.signals) signals += (signals.empty() ? "" : " ") + signal.name;
    rows.push_back({id_text(message), message.name,
                    fmt::format("{}{}", message.size, message.fd ? " FD" : ""), cycle_text(message),
                    sender_text(message), signals.empty() ? "-" : signals});
  }
  return aligned(rows);
}

Result<const Message*> named_message(const Database& database, const std::string& name) {
  if (const Message* message = find_message(database, name)) return message;
  std::uint32_t id = 0;
  const bool is_hexadecimal = name.starts_with("0x") || name.starts_with("0X");
  const char* end = name.data() + name.size();
  const auto read =
      std::from_chars(name.data() + (is_hexadecimal ? 2 : 0), end, id, is_hexadecimal ? 16 : 10);
  if (read.ec == std::errc{} && read.ptr == end) {
    const bool is_long = is_hexadecimal && name.size() == 10;
    for (const bool extended : {is_long, !is_long}) {
      if (const Message* message = find_message(database, id, extended)) return message;
    }
  }
  return failure(fmt::format("no message '{}', expected the name or the id of one of the {} messages", name,
                             database.messages.size()));
}

}  // namespace canhil::dbc
