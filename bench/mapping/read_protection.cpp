#include "bench/mapping/read_protection.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <vector>

#include "bench/scenario/section.hpp"
#include "dbc/protection/profiles.hpp"

namespace canhil::mapping {
namespace {

using scenario::Section;

std::uint64_t bits(Section& section, std::string_view key) {
  return static_cast<std::uint64_t>(section.optional_integer(key, 0).value_or(0));
}

std::vector<std::uint64_t> values(Section& section, std::string_view key) {
  std::vector<std::uint64_t> all;
  for (const std::int64_t value : section.integers(key, 0)) all.push_back(static_cast<std::uint64_t>(value));
  return all;
}

// If a library function returned an error, reports this error as an error of the key.
template <class Value>
std::optional<Value> or_reject(Section& section, std::string_view key, Result<Value> value) {
  if (value) return std::move(*value);
  if (!section.error()) section.reject(key, value.error());
  return std::nullopt;
}

// Reads a position in a message: either a signal of the DBC whose bits are used, or start bit, length and
// byte order as in a DBC.
protection::Place read_place(Section& section, const dbc::Message& message) {
  if (!section.has("start_bit")) {
    for (const std::string_view key : {"start_bit", "length", "byte_order"}) section.optional(key);
    const std::string name = section.text("signal");
    const dbc::Signal* signal = dbc::find_signal(message, name);
    if (signal != nullptr)
      return {.start_bit = signal->start_bit,
              .length = signal->length,
              .big_endian = signal->byte_order == dbc::ByteOrder::big_endian};
    if (!name.empty())
      section.reject("signal", fmt::format("{} has no signal '{}'", message.name, name), "the name of one");
    return {};
  }
  section.refuse("signal", "is given beside start_bit", "one of the two");
  section.optional("signal");
  static const std::vector<std::string> orders{"intel", "motorola"};
  return {.start_bit = static_cast<unsigned>(section.integer("start_bit", 0)),
          .length = static_cast<unsigned>(section.integer("length", 1)),
          .big_endian = section.one_of("byte_order", orders, orders.front()) == orders.back()};
}

std::optional<protection::Place> read_place_of(Section& section, std::string_view key,
                                               const dbc::Message& message) {
  auto table = section.optional_table(key);
  if (!table) return std::nullopt;
  const protection::Place place = read_place(*table, message);
  table->finish();
  return place;
}

protection::Counter read_counter(Section section, const dbc::Message& message) {
  protection::Counter counter;
  counter.place = read_place(section, message);
  counter.modulo = bits(section, "modulo");
  counter.skipped = values(section, "skipped");
  counter.shared_as = section.has("shared_as") ? section.text("shared_as") : "";
  section.optional("shared_as");
  section.finish();
  return counter;
}

// A number in decimal or hexadecimal ("0x1F").
Result<protection::AddedByte> added_byte(const std::string& word) {
  const bool hexadecimal = word.starts_with("0x");
  unsigned value = 0;
  const char* first = word.data() + (hexadecimal ? 2 : 0);
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, value, hexadecimal ? 16 : 10);
  if (error == std::errc() && end == last && value <= 0xFF)
    return protection::AddedByte{.source = protection::Source::constant,
                                 .value = static_cast<std::uint8_t>(value)};
  return protection::added_byte(word);
}

std::vector<protection::AddedByte> read_added(Section& section, std::string_view key) {
  std::vector<protection::AddedByte> all;
  for (const std::string& word : section.texts(key)) {
    if (const auto byte = or_reject(section, key, added_byte(word))) all.push_back(*byte);
  }
  return all;
}

std::variant<protection::Crc, protection::Sum> read_rule(Section& section) {
  if (section.has("model")) {  // an algorithm by its published name
    const auto crc = or_reject(section, "model", protection::published_crc(section.text("model")));
    return crc.value_or(protection::Crc{});
  }
  section.optional("model");
  if (!section.has("kind")) {
    section.reject("kind", "is missing", "'kind' or 'model'");
    return protection::Crc{};
  }
  auto rule =
      or_reject(section, "kind", protection::checksum_kind(section.text("kind"))).value_or(protection::Crc{});
  if (auto* crc = std::get_if<protection::Crc>(&rule)) {
    crc->polynomial = static_cast<std::uint64_t>(section.integer("polynomial", 0));
    crc->start = bits(section, "start");
    crc->input_reflected = section.flag("input_reflected");
    crc->output_reflected = section.flag("output_reflected");
    crc->final_xor = bits(section, "final_xor");
  } else if (auto* sum = std::get_if<protection::Sum>(&rule)) {
    sum->start = bits(section, "start");
    sum->negated = section.flag("negated");
    sum->final_xor = bits(section, "final_xor");
  }
  return rule;
}

protection::Checksum read_checksum(Section section, const dbc::Message& message) {
  protection::Checksum checksum;
  checksum.place = read_place(section, message);
  checksum.rule = read_rule(section);
  for (const std::uint64_t byte : values(section, "bytes"))
    checksum.bytes.push_back(static_cast<unsigned>(byte));
  const auto range = values(section, "byte_range");
  if (range.size() == 2)
    checksum.bytes = or_reject(section, "byte_range",
                               protection::byte_range(static_cast<std::int64_t>(range[0]),
                                                      static_cast<std::int64_t>(range[1])))
                         .value_or(std::vector<unsigned>());
  else if (!range.empty())
    section.reject("byte_range", fmt::format("has {} numbers", range.size()), "the first and the last byte");
  checksum.own_bytes_as_zero = section.flag("own_bytes_as_zero");
  checksum.before = read_added(section, "before");
  checksum.after = read_added(section, "after");
  section.finish();
  return checksum;
}

std::optional<protection::Settings> read_profile(Section& section, const dbc::Message& message,
                                                 std::uint32_t data_id) {
  protection::ProfileChoice choice;
  choice.data_id = data_id;
  for (const std::uint64_t id : values(section, "data_id_list"))
    choice.data_id_list.push_back(static_cast<std::uint8_t>(id));
  choice.offset_bits = static_cast<unsigned>(bits(section, "offset_bits"));
  choice.checksum = read_place_of(section, "checksum", message);
  choice.counter = read_place_of(section, "counter", message);
  choice.data_id_nibble = read_place_of(section, "data_id_nibble", message);
  return or_reject(section, "profile", protection::profile(section.text("profile"), choice, message.size));
}

protection::Settings read_parts(Section& section, const dbc::Message& message, std::uint32_t data_id) {
  for (const std::string_view key : {"offset_bits", "data_id_nibble"})
    section.refuse(key, "has no effect", "a profile beside it");
  protection::Settings settings;
  settings.data_id = data_id;
  for (const std::uint64_t id : values(section, "data_id_list"))
    settings.data_id_list.push_back(static_cast<std::uint8_t>(id));
  if (auto counter = section.optional_table("counter")) settings.counter = read_counter(*counter, message);
  if (auto checksum = section.optional_table("checksum"))
    settings.checksum = read_checksum(*checksum, message);
  if (section.has("constants")) {
    for (Section& constant : section.tables("constants")) {
      settings.constants.push_back(
          {.place = read_place(constant, message), .value = bits(constant, "value")});
      constant.finish();
    }
  }
  section.optional("constants");
  if (!settings.counter && !settings.checksum)
    section.reject("counter", "is missing", "'counter', 'checksum' or both, or a profile");
  return settings;
}

}  // namespace

std::optional<protection::Protection> read_protection(Section& section, const dbc::Message& message) {
  const auto data_id = static_cast<std::uint32_t>(bits(section, "data_id"));
  const bool profiled = section.has("profile");
  section.optional("profile");
  const auto settings = profiled ? read_profile(section, message, data_id)
                                 : std::optional(read_parts(section, message, data_id));
  if (!settings || section.error()) return std::nullopt;
  auto made = protection::Protection::make(*settings, {.id = message.id, .size = message.size});
  if (!made) made = failure(fmt::format("{}: {}", message.name, made.error().message));
  return or_reject(section, "messages", std::move(made));
}

}  // namespace canhil::mapping
