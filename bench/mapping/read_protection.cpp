#include "bench/mapping/read_protection.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/scenario/section.hpp"
#include "dbc/protection/profiles.hpp"

namespace canhil::mapping {
namespace {

using scenario::Section;

protection::Place place_of(const dbc::Signal& signal) {
  return {.start_bit = signal.start_bit,
          .length = signal.length,
          .big_endian = signal.byte_order == dbc::ByteOrder::big_endian};
}

// Of the signal that a key names.
std::optional<protection::Place> place(Section& section, std::string_view key, const dbc::Message& message) {
  const std::string name = section.text(key);
  const dbc::Signal* signal = dbc::find_signal(message, name);
  if (signal != nullptr) return place_of(*signal);
  if (!name.empty())
    section.reject(key, fmt::format("{} has no signal '{}'", message.name, name), "the name of one");
  return std::nullopt;
}

std::uint64_t bits(Section& section, std::string_view key, std::uint64_t fallback) {
  return static_cast<std::uint64_t>(
      section.optional_integer(key, 0).value_or(static_cast<std::int64_t>(fallback)));
}

std::vector<std::uint64_t> values(Section& section, std::string_view key) {
  std::vector<std::uint64_t> all;
  for (const std::int64_t value : section.integers(key, 0)) all.push_back(static_cast<std::uint64_t>(value));
  return all;
}

// What a library's function gives; its error is the key's.
template <class Value>
std::optional<Value> or_reject(Section& section, std::string_view key, Result<Value> value) {
  if (value) return std::move(*value);
  if (!section.error()) section.reject(key, value.error().message, "another");
  return std::nullopt;
}

protection::Counter read_counter(Section section, const dbc::Message& message) {
  protection::Counter counter;
  counter.place = place(section, "signal", message).value_or(protection::Place{});
  counter.modulo = bits(section, "modulo", 0);
  counter.skipped = values(section, "skip");
  counter.shared_as = section.has("shared") ? section.text("shared") : "";
  section.optional("shared");
  section.finish();
  return counter;
}

std::vector<protection::AddedByte> read_added(Section& section, std::string_view key) {
  std::vector<protection::AddedByte> all;
  for (const std::string& word : section.texts(key)) {
    if (const auto byte = or_reject(section, key, protection::added_byte(word))) all.push_back(*byte);
  }
  return all;
}

protection::Checksum read_checksum(Section section, const dbc::Message& message) {
  protection::Checksum checksum;
  checksum.place = place(section, "signal", message).value_or(protection::Place{});
  if (section.has("crc")) {  // by the name that it is published under
    if (const auto crc = or_reject(section, "crc", protection::published_crc(section.text("crc"))))
      checksum.rule = *crc;
  } else {
    section.optional("crc");
    if (const auto rule = or_reject(section, "kind", protection::checksum_kind(section.text("kind"))))
      checksum.rule = *rule;
    if (auto* crc = std::get_if<protection::Crc>(&checksum.rule)) {
      crc->polynomial = static_cast<std::uint64_t>(section.integer("polynomial", 0));
      crc->start = bits(section, "start", 0);
      crc->input_reflected = section.flag("input_reflected");
      crc->output_reflected = section.flag("output_reflected");
      crc->final_xor = bits(section, "final_xor", 0);
    } else if (auto* sum = std::get_if<protection::Sum>(&checksum.rule)) {
      sum->start = bits(section, "start", 0);
      sum->negated = section.flag("negated");
      sum->final_xor = bits(section, "final_xor", 0);
    }
  }
  for (const std::uint64_t byte : values(section, "bytes"))
    checksum.bytes.push_back(static_cast<unsigned>(byte));
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
  choice.offset_bits = static_cast<unsigned>(bits(section, "offset_bits", 0));
  if (section.has("checksum_signal")) choice.checksum = place(section, "checksum_signal", message);
  if (section.has("counter_signal")) choice.counter = place(section, "counter_signal", message);
  section.optional("checksum_signal");
  section.optional("counter_signal");
  return or_reject(section, "profile", protection::profile(section.text("profile"), choice, message.size));
}

}  // namespace

std::optional<protection::Protection> read_protection(Section& section, const dbc::Message& message) {
  const auto data_id = static_cast<std::uint32_t>(bits(section, "data_id", 0));
  std::optional<protection::Settings> settings;
  if (section.has("profile")) {
    settings = read_profile(section, message, data_id);
  } else {
    for (const std::string_view key :
         {"profile", "data_id_list", "offset_bits", "checksum_signal", "counter_signal"})
      section.refuse(key, "has no effect", "a profile beside it");
    settings.emplace();
    settings->data_id = data_id;
    if (auto counter = section.optional_table("counter")) settings->counter = read_counter(*counter, message);
    if (auto checksum = section.optional_table("checksum"))
      settings->checksum = read_checksum(*checksum, message);
    if (!settings->counter && !settings->checksum)
      section.reject("counter", "is missing, as is 'checksum'", "at least one of the two, or a profile");
  }
  if (!settings || section.error()) return std::nullopt;
  return or_reject(section, "messages",
                   protection::Protection::make(*settings, {.id = message.id, .size = message.size}));
}

}  // namespace canhil::mapping
