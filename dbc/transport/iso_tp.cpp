#include "dbc/transport/iso_tp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/wire/frame_rules.hpp"

namespace canhil::transport {
namespace {

enum Type : std::uint8_t { single = 0, first = 1, consecutive = 2, flow_control = 3 };
enum FlowStatus : std::uint8_t { go_on = 0, wait = 1, overflow = 2 };

constexpr unsigned classic_bytes = 8, numbers = 16;
constexpr std::size_t most_short_length = 0xFFF;  // of a first frame without the escape

std::uint8_t head(Type type, std::size_t low) { return static_cast<std::uint8_t>(type << 4U | (low & 0xFU)); }

Bytes padded(Bytes frame, std::uint8_t padding) {
  std::size_t size = std::max<std::size_t>(frame.size(), classic_bytes);
  while (!size_has_dlc(static_cast<std::uint8_t>(size), true)) ++size;
  frame.resize(size, padding);
  return frame;
}

// STmin: 0 to 127 ms, or 0xF1 to 0xF9: 100 to 900 us. A reserved value counts as 127 ms (9.6.5.4).
std::int64_t separation_of(std::uint8_t st_min) {
  constexpr std::uint8_t most_ms = 0x7F, least_tenths = 0xF1, most_tenths = 0xF9;
  if (st_min >= least_tenths && st_min <= most_tenths) return std::int64_t{100} * (st_min - 0xF0);
  return std::int64_t{1000} * std::min(st_min, most_ms);
}

std::size_t big_endian(std::span<const std::uint8_t> bytes) {
  std::size_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

}  // namespace

IsoTpSender::IsoTpSender(Bytes message, const IsoTpSettings& settings)
    : message_(std::move(message)), settings_(settings) {}

std::optional<Bytes> IsoTpSender::next() {
  if (!may_send()) return std::nullopt;
  Bytes frame;
  const std::size_t size = message_.size();
  if (done_ > 0) {
    frame.push_back(head(consecutive, number_));
    number_ = (number_ + 1) % numbers;
    if (left_ > 0 && --left_ == 0) waits_ = true;
  } else if (size < classic_bytes) {
    frame.push_back(head(single, size));
  } else if (settings_.frame_bytes > classic_bytes && size + 2 <= settings_.frame_bytes) {
    frame.assign({head(single, 0), static_cast<std::uint8_t>(size)});
  } else {
    if (size <= most_short_length)
      frame.assign({head(first, size >> 8U), static_cast<std::uint8_t>(size)});
    else
      frame.assign({head(first, 0), 0, static_cast<std::uint8_t>(size >> 24U),
                    static_cast<std::uint8_t>(size >> 16U), static_cast<std::uint8_t>(size >> 8U),
                    static_cast<std::uint8_t>(size)});
    waits_ = true;
    number_ = 1;
  }
  const std::size_t room = settings_.frame_bytes - frame.size();
  const std::size_t part = std::min(room, size - done_);
  const auto from = message_.begin() + static_cast<std::ptrdiff_t>(done_);
  frame.insert(frame.end(), from, from + static_cast<std::ptrdiff_t>(part));
  done_ += part;
  return padded(std::move(frame), settings_.padding);
}

void IsoTpSender::take(std::span<const std::uint8_t> frame) {
  if (over() || !waits_ || frame.size() < 3 || frame[0] >> 4U != flow_control) return;
  switch (frame[0] & 0xFU) {
    case go_on:
      waits_ = false;
      left_ = frame[1];
      separation_us_ = separation_of(frame[2]);
      return;
    case wait:
      return;
    case overflow:
      failure_ = "the receiver says that the message is too long for it (flow control 2)";
      return;
    default:
      failure_ = fmt::format("the receiver sent the flow control {}, expected 0 to 2", frame[0] & 0xFU);
  }
}

IsoTpReceiver::Taken IsoTpReceiver::take(std::span<const std::uint8_t> frame) {
  if (frame.empty()) return {};
  switch (frame[0] >> 4U) {
    case single:
    case first:
      return begin(frame);
    case consecutive:
      return go_on(frame);
    default:
      return {};
  }
}

IsoTpReceiver::Taken IsoTpReceiver::begin(std::span<const std::uint8_t> frame) {
  Taken taken;
  if (size_ != 0) taken.broken = "another message began before its last frame";
  size_ = 0;
  const bool is_single = frame[0] >> 4U == single;
  std::size_t at = is_single ? 1 : 2;
  if (frame.size() < at) return taken;
  std::size_t size = is_single ? frame[0] & 0xFU : (frame[0] & 0xFU) << 8U | frame[1];
  if (size == 0) {  // the escape for longer ones
    const std::size_t more = is_single ? 1 : 4;
    if (frame.size() < at + more) return taken;
    size = big_endian(frame.subspan(at, more));
    at += more;
  }
  if (size == 0) return taken;
  const auto content = frame.subspan(at);
  if (is_single) {
    if (content.size() < size) {
      taken.broken = fmt::format("a single frame of {} bytes says that it has {}", frame.size(), size);
    } else {
      taken.message = Bytes(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(size));
    }
    return taken;
  }
  const bool fits = size <= most_iso_tp_bytes;
  taken.flow_control =
      padded({head(flow_control, fits ? FlowStatus::go_on : FlowStatus::overflow), 0, 0}, settings_.padding);
  if (!fits) {
    taken.broken = fmt::format("it has {} bytes, the bench takes {}", size, most_iso_tp_bytes);
    return taken;
  }
  message_.assign(content.begin(),
                  content.begin() + static_cast<std::ptrdiff_t>(std::min(size, content.size())));
  size_ = size;
  number_ = 1;
  return taken;
}

IsoTpReceiver::Taken IsoTpReceiver::go_on(std::span<const std::uint8_t> frame) {
  Taken taken;
  if (size_ == 0) return taken;
  if ((frame[0] & 0xFU) != number_) {
    taken.broken = fmt::format("the consecutive frame {} came, expected {}", frame[0] & 0xFU, number_);
    size_ = 0;
    return taken;
  }
  number_ = (number_ + 1) % numbers;
  const auto content = frame.subspan(1);
  const std::size_t part = std::min(content.size(), size_ - message_.size());
  message_.insert(message_.end(), content.begin(), content.begin() + static_cast<std::ptrdiff_t>(part));
  if (message_.size() < size_) return taken;
  size_ = 0;
  taken.message = std::move(message_);
  message_ = {};
  return taken;
}

}  // namespace canhil::transport
