#include "bench/schedulability/message_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "dbc/wire/arbitration.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::schedulability {
namespace {

constexpr std::int64_t ns_per_us = 1'000;
constexpr double ns_per_ms = 1e6;

/// The value of a numeric attribute; 0 if the attribute is absent or not a number.
double number(const dbc::AttributeValue* value) {
  if (value == nullptr) return 0;
  if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(value);
  return real != nullptr ? *real : 0;
}

/// The value of a time attribute of a message, in ms; 0 if the attribute is absent.
double time_ms(const dbc::Database& database, const dbc::Message& message, std::string_view attribute) {
  return number(dbc::find_attribute(database, message.attributes, dbc::Owner::message, attribute));
}
std::int64_t time_ns(const dbc::Database& database, const dbc::Message& message, std::string_view attribute) {
  return std::llround(time_ms(database, message, attribute) * ns_per_ms);
}

/// Checks the time attributes of a message. The parser has already checked the cycle time.
Result<void> check_times(const dbc::Database& database, const dbc::Message& message) {
  for (const std::string_view attribute : {"GenMsgDelayTime", "GenMsgDeadline", "GenMsgJitter"}) {
    const double ms = time_ms(database, message, attribute);
    if (!dbc::is_message_time_ms(ms)) {
      return failure(fmt::format("message {} has {} {} ms, expected {}", message.name, attribute, ms,
                                 dbc::message_time_range));
    }
  }
  return {};
}

bool switches_bit_rate(const dbc::Database& database, const dbc::Message& message) {
  const auto* value = dbc::find_attribute(database, message.attributes, dbc::Owner::message, "CANFD_BRS");
  const auto* label = value != nullptr ? std::get_if<std::string>(value) : nullptr;
  return label != nullptr ? *label != "0" : value == nullptr || number(value) != 0;
}

/// The size of the smallest CAN FD frame that can carry so many bytes.
unsigned fd_frame_size(unsigned bytes) { return *std::ranges::lower_bound(size_of_dlc, bytes); }

void set_period(Stream& stream, const dbc::Database& database, const dbc::Message& message,
                const Assumptions& assumptions) {
  const std::int64_t least_ns = time_ns(database, message, "GenMsgDelayTime");
  if (message.cycle_time_us > 0) {
    stream.release = Release::cycle;
    stream.period_ns = message.cycle_time_us * ns_per_us;
  } else if (least_ns > 0) {
    stream.release = Release::interval;
    stream.period_ns = least_ns;
  } else if (assumptions.event_interval_ns > 0) {
    stream.release = Release::option;
    stream.period_ns = assumptions.event_interval_ns;
  } else {
    stream.release = Release::once;
  }
}

Stream stream_of(const dbc::Database& database, const dbc::Message& message, const Assumptions& assumptions) {
  Stream stream{
      .name = message.name, .id = message.id, .extended = message.extended, .sender = message.sender};
  set_period(stream, database, message, assumptions);
  const std::int64_t deadline_ns = time_ns(database, message, "GenMsgDeadline");
  if (deadline_ns > 0)
    stream.deadline_ns = deadline_ns;
  else if (stream.period_ns > 0)
    stream.deadline_ns = stream.period_ns;
  const std::int64_t jitter_ns = time_ns(database, message, "GenMsgJitter");
  stream.jitter_ns = jitter_ns > 0 ? jitter_ns : assumptions.jitter_ns;
  stream.length = message.fd ? wire::worst_case_fd_length(fd_frame_size(message.size), message.extended,
                                                          switches_bit_rate(database, message))
                             : wire::worst_case_length(message.size, message.extended);
  return stream;
}

}  // namespace

Result<std::vector<Stream>> streams_of(const dbc::Database& database, const Assumptions& assumptions,
                                       const wire::BitRates& rates) {
  std::vector<Stream> streams;
  for (const dbc::Message& message : database.messages) {
    if (auto checked = check_times(database, message); !checked) return tl::unexpected(checked.error());
    if ((message.j1939 || message.fast_packet) && message.size > 8) {
      return failure(
          fmt::format("message {} has {} bytes, which {} sends in several frames, expected at most 8",
                      message.name, message.size, message.fast_packet ? "NMEA 2000" : "SAE J1939"));
    }
    const Stream& stream = streams.emplace_back(stream_of(database, message, assumptions));
    if (stream.length.data > 0 && rates.data == 0) {
      return failure(
          fmt::format("message {} is CAN FD and switches the bit rate, expected --data-bitrate or the DBC's "
                      "BaudrateCANFD",
                      message.name));
    }
  }
  if (streams.empty()) return failure("no messages in the DBC, expected at least one");
  std::ranges::sort(streams, {}, [](const Stream& s) { return wire::arbitration_rank(s.id, s.extended); });
  return streams;
}

Result<wire::BitRates> bit_rates(const dbc::Database& database, const wire::BitRates& given) {
  const auto network = [&database](std::string_view attribute) {
    return std::llround(
        number(dbc::find_attribute(database, database.attributes, dbc::Owner::network, attribute)));
  };
  const wire::BitRates rates{.nominal = given.nominal > 0 ? given.nominal : network("Baudrate"),
                             .data = given.data > 0 ? given.data : network("BaudrateCANFD")};
  if (rates.nominal <= 0) return failure("no bit rate, expected --bitrate or the DBC's attribute Baudrate");
  if (rates.data > 0 && rates.data < rates.nominal)
    return failure(
        fmt::format("data phase at {} bit/s, expected at least the bit rate, {}", rates.data, rates.nominal));
  return rates;
}

}  // namespace canhil::schedulability
