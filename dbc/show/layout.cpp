#include <fmt/format.h>

#include <algorithm>

#include "dbc/show/show.hpp"
#include "dbc/show/table.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::dbc {
namespace {

/// The label of signal `number` in the matrix: A, B, ... Z, AA, AB, ... Labels are short, because the cells
/// are narrow.
std::string label(std::size_t number) {
  std::string text;
  for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / 26)
    text.insert(text.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return text;
}

/// The bits of a message as a matrix. A cell "A7" is bit 7 of the raw value of the signal with label A. "A7+"
/// means that other signals use this bit of the message too.
std::string matrix(const Message& message) {
  std::vector<std::string> cells(std::size_t{8} * message.size, ".");
  for (std::size_t s = 0; s < message.signals.size(); ++s) {
    const Signal& signal = message.signals[s];
    const bool big_endian = signal.byte_order == ByteOrder::big_endian;
    for (unsigned i = 0; i < signal.length; ++i) {
      std::string& cell = cells[wire::bit_position(signal.start_bit, i, big_endian)];
      if (cell == ".") {
        cell = label(s) + std::to_string(big_endian ? signal.length - 1 - i : i);
      } else if (!cell.ends_with('+')) {
        cell += '+';
      }
    }
  }
  std::vector<Row> rows{{"byte", "bit 7", "6", "5", "4", "3", "2", "1", "0"}};
  for (std::size_t byte = 0; byte < message.size; ++byte) {
    Row row{std::to_string(byte)};
    for (std::size_t bit = 8; bit-- > 0;) row.push_back(cells[8 * byte + bit]);
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

std::string when_text(const Signal& signal) {
  if (signal.multiplexed_by.empty()) return signal.multiplexor ? "always, multiplexor" : "always";
  std::string text;
  for (const MuxRange& range : signal.mux_ranges) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", range.first);
    if (range.last != range.first) text += fmt::format("..{}", range.last);
  }
  return fmt::format("{} is {}{}", signal.multiplexed_by, text, signal.multiplexor ? ", multiplexor" : "");
}

std::string values_text(const Signal& signal) {
  std::string text;
  for (const ValueName& value : signal.values)
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", value.value, value.name);
  return text.empty() ? "-" : text;
}

Row signal_row(std::size_t number, const Signal& signal) {
  const bool limited = signal.minimum != 0 || signal.maximum != 0;
  return {label(number),
          signal.name,
          std::to_string(signal.start_bit),
          std::to_string(signal.length),
          signal.byte_order == ByteOrder::big_endian ? "Motorola" : "Intel",
          std::string(name(signal.type)),
          fmt::format("{}", signal.scale),
          fmt::format("{}", signal.offset),
          limited ? fmt::format("{}..{}", signal.minimum, signal.maximum) : "-",
          signal.unit.empty() ? "-" : signal.unit,
          when_text(signal),
          values_text(signal)};
}

std::string head(const Message& message) {
  std::string text =
      fmt::format("{} {}, {} bytes{}, cycle {}, sender {}\n", id_text(message), message.name, message.size,
                  message.fd ? " (FD)" : "", cycle_text(message), sender_text(message));
  std::string comment = message.comment;
  std::ranges::replace(comment, '\n', ' ');
  return comment.empty() ? text : text + one_line(comment) + "\n";
}

}  // namespace

std::string message_page(const Message& message) {
  std::vector<Row> rows{{"", "signal", "start", "length", "order", "type", "scale", "offset", "range", "unit",
                         "present when", "values"}};
  for (std::size_t i = 0; i < message.signals.size(); ++i) rows.push_back(signal_row(i, message.signals[i]));
  const std::string bits = matrix(message);
  const bool is_shared = bits.find('+') != std::string::npos;
  return head(message) + "\n" + bits + "A7: bit 7 of the raw value of signal A" +
         (is_shared ? "; +: also bits of other signals\n\n" : "\n\n") + aligned(rows);
}

}  // namespace canhil::dbc
