#include "dbc/codegen/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dbc/codegen/names.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::dbc {
namespace {

/// True if packing rounds the signal. The member of such a signal is a double, which packing converts to a
/// raw value with a scale or an offset. False for a multiplexor, whose raw value decides which signals are
/// present.
bool is_rounded(const Message& message, const Signal& signal) {
  return !is_protection(message, signal) && !is_plain(signal) && !signal.multiplexor;
}

std::string signals_text(const Message& message) {
  const auto members = members_of(message);
  std::string text = fmt::format("namespace {{\nconstexpr std::array<SignalInfo, {}> signals_of_{}{{{{\n",
                                 members.size(), type_name(message));
  for (const Signal* s : members) {
    text += fmt::format(
        "    {{.name = {}, .unit = {}, .scale = {}, .offset = {}, .minimum = {}, .maximum = {},\n"
        "     .sensor_sigma = {}, .carries_remainder = {}, .start_bit = {}, .length = {}, .big_endian = {},\n"
        "     .is_float = {}, .multiplexed = {}}},\n",
        in_quotes(s->name), in_quotes(s->unit), literal(s->scale), literal(s->offset), literal(s->minimum),
        literal(s->maximum), literal(s->sensor_sigma), s->carries_remainder, s->start_bit, s->length,
        s->byte_order == ByteOrder::big_endian, s->is_float(), !s->multiplexed_by.empty());
  }
  return text + "}};\n}  // namespace\n";
}

/// The range of the signal's physical values. It equals the range of the raw values of a 64-bit float signal
/// that has scale 1, offset 0 and the limits of this signal.
RealRange physical_range(Signal signal) {
  signal.type = RawType::float64;
  signal.scale = 1;
  signal.offset = 0;
  return real_range(signal);
}

std::string scaled_text(const Message& message) {
  const std::string type = type_name(message);
  std::string rows;
  std::size_t count = 0;
  for (const Signal& signal : message.signals) {
    if (!is_rounded(message, signal)) continue;
    const RealRange range = physical_range(signal);
    rows += fmt::format("    {{.offset = offsetof({}, {}), .lowest = {}, .highest = {}}},\n", type,
                        member_name(message, signal), literal(range.lowest), literal(range.highest));
    ++count;
  }
  return fmt::format(
      "  static constexpr std::array<wire::ScaledMember, {}> members{{{{\n{}  }}}};\n  return members;\n",
      count, rows);
}

}  // namespace

bool can_travel_unrounded(const Message& message) {
  std::size_t bytes = message.size;
  for (const Signal& signal : message.signals) {
    if (!is_rounded(message, signal)) continue;
    if (!signal.multiplexed_by.empty()) return false;
    bytes += sizeof(double);
  }
  return bytes <= Frame::max_size;
}

std::string definitions_text(const Message& message) {
  return signals_text(message) +
         fmt::format(
             "static_assert(wire::is_sound({0}::info, signals_of_{0}));\n"
             "static_assert(wire::is_fine_enough(signals_of_{0}));\n"
             "std::span<const SignalInfo> {0}::signals() noexcept {{ return signals_of_{0}; }}\n"
             "std::span<const wire::ScaledMember> {0}::scaled() noexcept {{\n{1}}}\n\n",
             type_name(message), can_travel_unrounded(message) ? scaled_text(message) : "  return {};\n");
}

}  // namespace canhil::dbc
