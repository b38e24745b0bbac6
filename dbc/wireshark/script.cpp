#include "dbc/wireshark/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "dbc/wire/bits.hpp"

namespace canhil::dbc {
namespace {

std::string lua_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || c == '"' || c == '\\') {
      out += fmt::format("\\{:03}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// A part of a display filter: Wireshark accepts only these characters.
std::string filter_name(std::string_view name) {
  std::string out(name);
  std::ranges::replace_if(
      out, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_'; }, '_');
  return out;
}

/// The name of the protocol: the stem of the file name, in lower case.
std::string protocol_name(std::string_view source) {
  source = source.substr(source.rfind('/') + 1);  // npos + 1 is 0
  std::string name = filter_name(source.substr(0, source.rfind('.')));
  std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
  // A name must not equal that of a protocol which Wireshark knows, such as can.
  return "dbc_" + name;
}

/// The parts of bytes that contain a signal, and the first and the end byte of the signal.
struct Pieces {
  std::string text;
  unsigned first = 64, end = 0;
};

Pieces pieces_of(const Signal& signal) {
  Pieces pieces;
  const bool big_endian = signal.byte_order == ByteOrder::big_endian;
  // The bits from the most significant one. Bits of one byte that follow each other form a piece.
  for (unsigned i = 0; i < signal.length;) {
    const auto position = [&](unsigned n) {
      return wire::bit_position(signal.start_bit, big_endian ? n : signal.length - 1 - n, big_endian);
    };
    const unsigned byte = position(i) / 8;
    unsigned bits = 1;
    while (i + bits < signal.length && position(i + bits) / 8 == byte) ++bits;
    pieces.text += fmt::format("{{{},{},{}}},", byte, position(i + bits - 1) % 8, bits);
    pieces.first = std::min(pieces.first, byte);
    pieces.end = std::max(pieces.end, byte + 1);
    i += bits;
  }
  return pieces;
}

std::string multiplexing_text(const Message& message, const Signal& signal) {
  if (signal.multiplexed_by.empty()) return "";
  std::string ranges;
  for (const MuxRange& range : signal.mux_ranges)
    ranges += fmt::format("{{{},{}}},", range.first, range.last);
  const auto index = find_signal(message, signal.multiplexed_by) - message.signals.data();
  return fmt::format(", multiplexor = {}, ranges = {{{}}}", index + 1, ranges);
}

std::string signal_text(const Message& message, const Signal& signal) {
  const Pieces pieces = pieces_of(signal);
  std::string values;
  for (const ValueName& value : signal.values)
    values += fmt::format("[\"{}\"] = {}, ", value.value, lua_string(value.name));
  return fmt::format(
      "    {{ name = {}, filter = \"{}\", kind = \"{}\", plain = {}, length = {}, first = {}, bytes = {}, "
      "scale = "
      "{}, offset = {}, unit = {},\n      pieces = {{{}}}, values = {{{}}}{} }},\n",
      lua_string(signal.name), filter_name(signal.name), name(signal.type),
      signal.scale == 1 && signal.offset == 0, signal.length, pieces.first, pieces.end, signal.scale,
      signal.offset, lua_string(signal.unit), pieces.text, values, multiplexing_text(message, signal));
}

}  // namespace

std::string wireshark_script(const Database& database, std::string_view source) {
  std::string text = fmt::format(
      "-- Signals of {0} for tshark and Wireshark: tshark -X lua_script:FILE ...\n"
      "-- Made by 'hil-bench dbc wireshark'; do not edit.\n"
      "local protocol = {{ name = \"{1}\", source = {2} }}\nlocal messages = {{\n",
      filter_name(source.substr(source.rfind('/') + 1)), protocol_name(source), lua_string(source));
  for (const Message& message : database.messages) {
    text += fmt::format("  {{ name = {}, filter = \"{}\", id = {}, extended = {}, j1939 = {}, signals = {{\n",
                        lua_string(message.name), filter_name(message.name), message.id, message.extended,
                        message.j1939);
    for (const Signal& signal : message.signals) text += signal_text(message, signal);
    text += "  } },\n";
  }
  return text + "}\n" + std::string(wireshark_dissector);
}

}  // namespace canhil::dbc
