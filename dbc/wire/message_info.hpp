// Messages of the DBC as constants: dbcgen fills them in; codecs, monitors and schedules read them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace canhil {

/// One signal of a message. physical = raw * scale + offset, clamped to [minimum, maximum] when packed.
struct SignalInfo {
  std::string_view name{};
  std::string_view unit{};
  double scale = 1;
  double offset = 0;
  double minimum = 0;
  double maximum = 0;
  double sensor_sigma =
      0;  ///< per-sample 1-sigma noise of the sensor in the signal's unit; 0: not a measurement
  bool carries_remainder = false;  ///< the sender adds the rounding error of an increment to the next sample
  unsigned start_bit = 0;          ///< as the DBC counts
  unsigned length = 0;             ///< bits
  bool big_endian = false;
  bool is_float = false;     ///< the raw value is a float: not rounded to steps
  bool multiplexed = false;  ///< not in every frame of the message
};

namespace wire {

/// The step between neighbouring values of a signal, in its unit; 0 for a float, which has no fixed step.
constexpr double lsb(double scale, bool is_float) { return is_float ? 0 : scale < 0 ? -scale : scale; }
/// The step of a signal, in its unit; 0: a float.
constexpr double lsb(const SignalInfo& signal) { return lsb(signal.scale, signal.is_float); }

}  // namespace wire

/// One message.
struct MessageInfo {
  std::string_view name{};
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint8_t size = 0;
  std::int64_t cycle_time_us = 0;  ///< 0: event-triggered
  std::uint16_t e2e_data_id = 0;   ///< 0: not protected
  std::string_view sender{};
  std::string_view sample_group{};              ///< empty: none
  std::span<const std::string_view> answers{};  ///< sample groups that this message answers
  bool can_travel_unrounded = false;  ///< a Frame has room for its scaled signals as doubles behind its bytes
};

}  // namespace canhil
