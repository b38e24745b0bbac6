#include "dbc/codegen/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dbc/wire/generated.hpp"

namespace canhil::dbc {
namespace {

using wire::Resolution;

double lsb_of(const Signal& signal) { return wire::lsb(signal.scale, signal.is_float()); }

Resolution resolution_of(const Signal& signal) {
  return wire::resolution_of(signal.name, lsb_of(signal), signal.sensor_sigma, signal.carries_remainder);
}

bool is_at(const Message& message, std::string_view name, unsigned start_bit, unsigned length) {
  const Signal* signal = find_signal(message, name);
  return signal != nullptr && signal->start_bit == start_bit && signal->length == length &&
         signal->byte_order == ByteOrder::little_endian && signal->type == RawType::unsigned_integer &&
         signal->multiplexed_by.empty();
}

std::optional<Breach> protection_breach(const Message& message) {
  if (message.e2e_data_id == 0) return std::nullopt;
  if (is_at(message, "e2e_crc", 0, 8) && is_at(message, "e2e_counter", 8, 4)) return std::nullopt;
  return Breach{message.at,
                fmt::format("message {} has an E2eDataId, expected the signals e2e_crc : 0|8@1+ and "
                            "e2e_counter : 8|4@1+",
                            message.name)};
}

/// All messages of a sample group must answer the same sample groups. Each answered group must be sent by
/// another node.
std::optional<Breach> answer_breach(const Database& database, const Message& message) {
  for (const std::string& group : message.answers) {
    const auto answered = std::ranges::find(database.messages, group, &Message::sample_group);
    if (answered == database.messages.end() || answered->sender == message.sender) {
      return Breach{message.at,
                    fmt::format("message {} answers {}, expected the sample groups of other nodes",
                                message.name, group)};
    }
  }
  if (message.sample_group.empty()) return std::nullopt;
  const Message& first = *std::ranges::find(database.messages, message.sample_group, &Message::sample_group);
  if (message.answers == first.answers) return std::nullopt;
  return Breach{
      message.at,
      fmt::format("message {} answers \"{}\", expected \"{}\" as {} of its sample group", message.name,
                  fmt::join(message.answers, " "), fmt::join(first.answers, " "), first.name)};
}

std::optional<Breach> resolution_breach(const Message& message, const Signal& signal) {
  const std::string name = fmt::format("{}.{}", message.name, signal.name);
  switch (resolution_of(signal)) {
    case Resolution::enough:
      return std::nullopt;
    case Resolution::too_coarse:
      return Breach{
          signal.at,
          fmt::format(
              "signal {} has LSB {} for a sensor sigma of {}, expected LSB / sqrt(12) <= sigma / 4: "
              "at most {:.3g}",
              name, signal.scale, signal.sensor_sigma,
              wire::largest_quantisation_ratio * signal.sensor_sigma / wire::quantisation_ratio(1, 1))};
    case Resolution::loses_remainder:
      return Breach{
          signal.at,
          fmt::format("signal {} is an increment, expected the attribute CarriesRemainder \"yes\"", name)};
    case Resolution::unknown_sigma:
      return Breach{
          signal.at,
          fmt::format("signal {} carries its remainder but has no sensor, expected SensorSigma > 0", name)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Breach> find_breach(const Database& database) {
  for (const Message& message : database.messages) {
    if (auto breach = protection_breach(message)) return breach;
    if (auto breach = answer_breach(database, message)) return breach;
    for (const Signal& signal : message.signals) {
      if (auto breach = resolution_breach(message, signal)) return breach;
    }
  }
  return std::nullopt;
}

std::string quantisation_table(const Database& database) {
  std::string text = fmt::format("{:<44} {:>10} {:>12} {:>8} {:>10}  {}\n", "signal", "LSB", "sensor sigma",
                                 "ratio", "remainder", "verdict");
  for (const Message& message : database.messages) {
    for (const Signal& signal : message.signals) {
      const Resolution resolution = resolution_of(signal);
      if (signal.sensor_sigma <= 0 && resolution == Resolution::enough) continue;
      text += fmt::format(
          "{:<44} {:>10.4g} {:>12.4g} {:>8.3f} {:>10}  {}\n", message.name + "." + signal.name,
          lsb_of(signal), signal.sensor_sigma, wire::quantisation_ratio(lsb_of(signal), signal.sensor_sigma),
          signal.carries_remainder ? "carried" : "-", resolution == Resolution::enough ? "ok" : "NOT ENOUGH");
    }
  }
  return text + fmt::format("ratio = LSB / sqrt(12) / sigma, at most {}\n", wire::largest_quantisation_ratio);
}

}  // namespace canhil::dbc
