#include "dbc/codegen/message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dbc/codegen/definitions.hpp"
#include "dbc/codegen/placement.hpp"
#include "dbc/wire/quantise.hpp"

namespace canhil::dbc {
namespace {

std::string word_name(const Word& word) {
  return fmt::format("{}_word_{}_", word.order == ByteOrder::little_endian ? "le" : "be", word.first);
}

std::set<Word> words_of(const Message& message, const std::vector<const Signal*>& members) {
  std::set<Word> words;
  for (const Signal* signal : members) {
    for (const Piece& piece : pieces_of(message, *signal)) words.insert(piece.word);
  }
  return words;
}

/// A C++ expression for the raw value of the signal. The type of the expression is std::int64_t for a signed
/// signal, otherwise std::uint64_t.
std::string raw_expression(const Message& message, const Signal& signal) {
  std::string text;
  const bool is_signed = signal.is_signed();
  for (const Piece& piece : pieces_of(message, signal)) {
    const bool top = text.empty();
    if (!top) text += " | ";
    std::string bits = fmt::format("wire::{}_bits<{}, {}>({})", top && is_signed ? "signed" : "unsigned",
                                   piece.shift, piece.length, word_name(piece.word));
    if (!top && is_signed) bits = fmt::format("static_cast<std::int64_t>({})", bits);
    text += piece.raw_shift == 0 ? bits : fmt::format("({} << {})", bits, piece.raw_shift);
  }
  return text;
}

std::string unpack_expression(const Enums& enums, const Message& message, const Signal& signal) {
  const std::string raw = raw_expression(message, signal);
  const std::string type = member_type(enums, message, signal);
  std::string value = raw;
  if (signal.is_float()) {
    value = fmt::format("wire::real<{}>({})", signal.type == RawType::float32 ? "float" : "double", raw);
    if (is_plain(signal)) return value;
  }
  if (is_plain(signal)) return fmt::format("static_cast<{}>({})", type, raw);
  return fmt::format("wire::physical(static_cast<double>({}), {}, {})", value, literal(signal.scale),
                     literal(signal.offset));
}

std::string integer_literal(std::int64_t raw, bool is_signed) {
  if (!is_signed) return fmt::format("std::uint64_t{{{}U}}", static_cast<std::uint64_t>(raw));
  if (raw == INT64_MIN) return "INT64_MIN";
  return fmt::format("std::int64_t{{{}}}", raw);
}

/// A C++ expression of type std::uint64_t: the raw bits of the member, rounded and saturated.
std::string pack_expression(const Message& message, const Signal& signal) {
  const std::string name = member_name(message, signal);
  const auto scaled = [&](std::string_view function, double low, double high) {
    return fmt::format("wire::{}({}, {}, {}, {}, {})", function, name, literal(signal.scale),
                       literal(signal.offset), literal(low), literal(high));
  };
  if (signal.is_float()) {
    const RealRange range = real_range(signal);
    return scaled(signal.type == RawType::float32 ? "float_bits<float>" : "float_bits<double>", range.lowest,
                  range.highest);
  }
  const RawRange range = raw_range(signal).value();
  const bool is_signed = signal.is_signed();
  if (is_plain(signal)) {
    return fmt::format("wire::saturated(static_cast<std::{}int64_t>({}), {}, {})", is_signed ? "" : "u", name,
                       integer_literal(range.lowest, is_signed), integer_literal(range.highest, is_signed));
  }
  if (is_signed) return scaled("quantised", wire::bound(range.lowest), wire::bound(range.highest));
  return scaled(signal.length == 64 ? "quantised_wide" : "quantised",
                wire::bound(static_cast<std::uint64_t>(range.lowest)),
                wire::bound(static_cast<std::uint64_t>(range.highest)));
}

std::string raw_name(const Signal& signal) { return "raw_of_" + identifier(signal.name) + "_"; }

/// A condition in C++ that is true if the frame contains the signal. It compares the raw values of the
/// multiplexors. Empty: every frame of the message contains the signal.
std::string presence(const Message& message, const Signal& signal) {
  if (signal.multiplexed_by.empty()) return {};
  const Signal& multiplexor = *find_signal(message, signal.multiplexed_by);
  std::string any;
  for (const MuxRange& range : signal.mux_ranges) {
    if (!any.empty()) any += " || ";
    const std::string raw = raw_name(multiplexor);
    any += range.first == range.last ? fmt::format("{} == {}U", raw, range.first)
           : range.first == 0        ? fmt::format("{} <= {}U", raw, range.last)
                              : fmt::format("({} >= {}U && {} <= {}U)", raw, range.first, raw, range.last);
  }
  const std::string above = presence(message, multiplexor);
  const std::string own = signal.mux_ranges.size() > 1 ? "(" + any + ")" : any;
  return above.empty() ? own : above + " && " + own;
}

std::string guarded(const std::string& condition, const std::string& statements) {
  if (condition.empty()) return statements;
  return fmt::format("    if ({}) {{\n{}    }}\n", condition, statements);
}

std::string unpack_text(const Enums& enums, const Message& message,
                        const std::vector<const Signal*>& members) {
  std::string text;
  const std::string type = type_name(message);
  text += fmt::format(
      "  /// Decodes the frame's bytes.\n  static constexpr {} unpack([[maybe_unused]] std::span<const "
      "std::uint8_t, "
      "size> data_) noexcept {{\n",
      type);
  for (const Word& word : words_of(message, members)) {
    text += fmt::format("    const std::uint64_t {} = wire::load_{}<{}, {}>(data_.data());\n",
                        word_name(word), word_name(word).substr(0, 2), word.first, word.bytes);
  }
  for (const Signal* signal : members) {
    if (signal->multiplexor) {
      text += fmt::format("    [[maybe_unused]] const std::uint64_t {} = {};\n", raw_name(*signal),
                          raw_expression(message, *signal));
    }
  }
  text += fmt::format("    {} message_;\n", type);
  for (const Signal* signal : members) {
    text += guarded(presence(message, *signal),
                    fmt::format("    message_.{} = {};\n", member_name(message, *signal),
                                unpack_expression(enums, message, *signal)));
  }
  return text + "    return message_;\n  }\n";
}

std::string pack_text(const Message& message, const std::vector<const Signal*>& members) {
  std::string text =
      "  /// Encodes into the frame's bytes: rounded half to even, saturated, NaN to the minimum; E2E fields "
      "and unused bits are 0.\n"
      "  constexpr void pack([[maybe_unused]] std::span<std::uint8_t, size> data_) const noexcept {\n";
  const auto words = words_of(message, members);
  for (const Word& word : words) text += fmt::format("    std::uint64_t {} = 0;\n", word_name(word));
  for (const Signal* signal : members) {
    if (signal->multiplexor)
      text += fmt::format("    const std::uint64_t {} = {};\n", raw_name(*signal),
                          pack_expression(message, *signal));
  }
  for (const Signal* signal : members) {
    const auto pieces = pieces_of(message, *signal);
    std::string raw = signal->multiplexor ? raw_name(*signal) : pack_expression(message, *signal);
    std::string statements;
    if (pieces.size() > 1) {
      statements += fmt::format("    const std::uint64_t {} = {};\n", raw_name(*signal), raw);
      raw = raw_name(*signal);
    }
    for (const Piece& piece : pieces) {
      statements += fmt::format("    {} |= wire::placed<{}, {}>({});\n", word_name(piece.word), piece.shift,
                                piece.length,
                                piece.raw_shift == 0 ? raw : fmt::format("{} >> {}", raw, piece.raw_shift));
    }
    text += guarded(presence(message, *signal), statements);
  }
  const bool whole = words.size() == 1 && words.begin()->bytes == message.size;
  if (!whole && message.size > 0) text += "    std::ranges::fill(data_, std::uint8_t{0});\n";
  for (const Word& word : words) {
    text += fmt::format("    wire::{}_{}<{}, {}>(data_.data(), {});\n", whole ? "store" : "merge",
                        word_name(word).substr(0, 2), word.first, word.bytes, word_name(word));
  }
  return text + "  }\n";
}

std::string visit_text(const Message& message, const std::vector<const Signal*>& members) {
  std::string calls;
  for (std::size_t i = 0; i < members.size(); ++i)
    calls += fmt::format("    visitor_(signals_[{}], message_.{});\n", i, member_name(message, *members[i]));
  return fmt::format(
      "  /// Calls visitor(info, member) for every signal, in the order of the DBC.\n"
      "  template <class Message_, class Visitor_>\n  static void visit([[maybe_unused]] Message_& message_, "
      "[[maybe_unused]] Visitor_&& visitor_) {{\n    [[maybe_unused]] const auto signals_ = signals();\n{}  "
      "}}\n",
      calls);
}

std::string comment_line(std::string_view indent, std::string_view text) {
  std::string line;
  for (const char c : text) line += c == '\n' ? ' ' : c;
  while (line.ends_with('\\') || line.ends_with(' '))
    line.pop_back();  // a backslash at the end would make the next line part of the comment
  return line.empty() ? "" : fmt::format("{}/// {}\n", indent, line);
}

std::string members_text(const Enums& enums, const Message& message,
                         const std::vector<const Signal*>& members) {
  std::string text;
  for (const Signal* signal : members) {
    const std::string unit = signal->unit.empty() ? "" : fmt::format("[{}] ", signal->unit);
    text += comment_line("  ", unit + signal->comment);
    text +=
        fmt::format("  {} {}{{}};\n", member_type(enums, message, *signal), member_name(message, *signal));
  }
  return text;
}

std::string answers_text(const Message& message) {
  std::string text =
      fmt::format("namespace detail {{\ninline constexpr std::array<std::string_view, {}> answers_of_{}{{",
                  message.answers.size(), type_name(message));
  for (const std::string& group : message.answers) text += in_quotes(group) + ", ";
  return text + "};\n}  // namespace detail\n\n";
}

}  // namespace

std::string message_text(const Enums& enums, const Message& message) {
  const auto members = members_of(message);
  const std::string type = type_name(message);
  std::string text = message.answers.empty() ? "" : answers_text(message);
  text += comment_line("", message.comment);
  text += fmt::format("struct {} {{\n", type) + members_text(enums, message, members);
  text += fmt::format("\n  static constexpr std::size_t size = {};\n", message.size);
  text += fmt::format(
      "  static constexpr MessageInfo info{{.name = {}, .id = 0x{:X}, .extended = {}, .fd = {}, .size = "
      "size,\n"
      "                                   .cycle_time_us = {}, .e2e_data_id = {}, .sender = {},\n"
      "                                   .sample_group = {}, .answers = {},\n"
      "                                   .can_travel_unrounded = {}}};\n"
      "  /// In the order of the DBC, without the E2E fields.\n"
      "  static std::span<const SignalInfo> signals() noexcept;\n"
      "  /// The members that `pack` rounds.\n"
      "  static std::span<const wire::ScaledMember> scaled() noexcept;\n\n",
      in_quotes(message.name), message.id, message.extended, message.fd, message.cycle_time_us,
      message.e2e_data_id, in_quotes(message.sender), in_quotes(message.sample_group),
      message.answers.empty() ? "{}" : fmt::format("detail::answers_of_{}", type),
      can_travel_unrounded(message));
  text += unpack_text(enums, message, members) + pack_text(message, members) + visit_text(message, members);
  text +=
      fmt::format("\n  friend constexpr bool operator==(const {0}&, const {0}&) = default;\n}};\n\n", type);
  return text;
}

}  // namespace canhil::dbc
