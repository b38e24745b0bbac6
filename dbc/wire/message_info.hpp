// Descriptions of the messages of a DBC. dbcgen generates them as constants; codecs, monitors and schedules
// use them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace canhil {

/// A signal of a message. Its physical value is raw * scale + offset. Packing clamps it to [minimum,
/// maximum].
struct SignalInfo {
  std::string_view name{};
  std::string_view unit{};
  double scale = 1;
  double offset = 0;
  double minimum = 0;
  double maximum = 0;
  double sensor_sigma =
      0;  ///< sigma of the noise of one sample of the sensor, in the signal's unit; 0: not a measurement
  bool carries_remainder =
      false;               ///< true: the sender adds the rounding error of an increment to the next sample
  unsigned start_bit = 0;  ///< in the numbering of the DBC
  unsigned length = 0;     ///< number of bits
  bool big_endian = false;
  bool is_float = false;     ///< true: the raw value is a float and is not rounded to steps
  bool multiplexed = false;  ///< true: not every frame of the message contains the signal
};

namespace wire {

/// The step between neighbouring values of a signal, in the unit of the signal; 0 for a float, which has no
/// fixed step.
constexpr double lsb(double scale, bool is_float) { return is_float ? 0 : scale < 0 ? -scale : scale; }
/// The step of a signal, in the unit of the signal; 0 for a float.
constexpr double lsb(const SignalInfo& signal) { return lsb(signal.scale, signal.is_float); }

}  // namespace wire

/// A message of the DBC.
struct MessageInfo {
  std::string_view name{};
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint8_t size = 0;
  std::int64_t cycle_time_us = 0;  ///< 0: the message is event-triggered
  std::uint16_t e2e_data_id = 0;   ///< 0: the message has no E2E protection
  std::string_view sender{};
  std::string_view sample_group{};              ///< empty: the message has no sample group
  std::span<const std::string_view> answers{};  ///< the sample groups that this message answers
  /// True if a Frame has room for the scaled signals of the message as doubles behind the packed bytes.
  bool can_travel_unrounded = false;
};

/// The sender of the bench's own messages, whatever DBC these are of.
inline constexpr std::string_view bench_node = "Bench";
/// The sender of the messages of the device under test, whatever DBC these are of.
inline constexpr std::string_view target_node = "Target";
/// Whether the device under test sends a message.
constexpr bool is_targets(const MessageInfo& info) { return info.sender == target_node; }
/// Whether a message belongs to the sample group that the message `closing` closes. A message without a group
/// is a group of its own.
constexpr bool is_in_group_of(const MessageInfo& message, const MessageInfo& closing) {
  if (closing.sample_group.empty()) return message.name == closing.name;
  return message.sample_group == closing.sample_group && message.sender == closing.sender;
}

}  // namespace canhil
