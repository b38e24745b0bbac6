// The transport protocol of diagnostics (ISO 15765-2, "ISO-TP") with normal addressing: a message of up to
// 4 GiB in frames of one id, which the receiver paces with flow control in frames of another id.
//
// The upper half of byte 0 tells the type of a frame: 0 a single frame, 1 the first frame, 2 a consecutive
// frame, 3 flow control. Frames of CAN FD have an escape for lengths of more than 7 bytes. Unused bytes up to
// the next size of a frame, at least 8, are padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace canhil::transport {

using Bytes = std::vector<std::uint8_t>;

struct IsoTpSettings {
  unsigned frame_bytes = 8;     ///< size of a full frame: 8, with CAN FD up to 64
  std::uint8_t padding = 0xCC;  ///< the value that ISO 15765-2 recommends, which needs no stuff bits
};

/// Sends one message.
class IsoTpSender {
 public:
  /// `message`: 1 byte to 4 GiB.
  IsoTpSender(Bytes message, const IsoTpSettings& settings);

  /// The next frame; none: the sender waits for flow control, has sent everything or gave up.
  std::optional<Bytes> next();
  /// Takes a frame of the receiver. Frames other than flow control do nothing.
  void take(std::span<const std::uint8_t> frame);
  /// Whether next() would return a frame.
  [[nodiscard]] bool may_send() const { return !over() && !waits_; }
  /// Whether the message is complete, or given up.
  [[nodiscard]] bool over() const { return done_ == message_.size() || !failure_.empty(); }
  /// Why the message is given up; empty: it is not.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// The least time between two consecutive frames (STmin) [us].
  [[nodiscard]] std::int64_t separation_us() const { return separation_us_; }

 private:
  Bytes message_;
  IsoTpSettings settings_;
  std::size_t done_ = 0;
  unsigned number_ = 0;  // of the next consecutive frame
  bool waits_ = false;
  unsigned left_ = 0;  // consecutive frames until the next flow control; 0: no limit
  std::int64_t separation_us_ = 0;
  std::string failure_;
};

/// Puts the messages of one id together.
class IsoTpReceiver {
 public:
  explicit IsoTpReceiver(const IsoTpSettings& settings) : settings_(settings) {}

  struct Taken {
    std::optional<Bytes> message{};       ///< the message that the frame completes
    std::optional<Bytes> flow_control{};  ///< the frame that the sender must get now
    std::string broken{};                 ///< why the message that was open is lost; empty: it is not
  };
  Taken take(std::span<const std::uint8_t> frame);

 private:
  Taken begin(std::span<const std::uint8_t> frame);
  Taken go_on(std::span<const std::uint8_t> frame);

  IsoTpSettings settings_;
  Bytes message_;
  std::size_t size_ = 0;  // of the open message; 0: none is open
  unsigned number_ = 0;   // of the next consecutive frame
};

/// The longest message that IsoTpReceiver takes; it answers a longer one with the flow control "overflow".
inline constexpr std::size_t most_iso_tp_bytes = std::size_t{1} << 20U;

}  // namespace canhil::transport
