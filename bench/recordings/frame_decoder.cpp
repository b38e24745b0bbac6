#include "bench/recordings/frame_decoder.hpp"

#include <algorithm>

#include "dbc/parser/codec.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::recordings {
namespace {

unsigned bytes_of(const dbc::Signal& signal) {
  unsigned bytes = 0;
  for (unsigned i = 0; i < signal.length; ++i)
    bytes = std::max(
        bytes,
        1 + wire::bit_position(signal.start_bit, i, signal.byte_order == dbc::ByteOrder::big_endian) / 8);
  return bytes;
}

unsigned multiplexor_bytes_of(const dbc::Message& message, const dbc::Signal& signal) {
  unsigned bytes = 0;
  for (const dbc::Signal* one = &signal; !one->multiplexed_by.empty();) {
    one = dbc::find_signal(message, one->multiplexed_by);
    bytes = std::max(bytes, bytes_of(*one));
  }
  return bytes;
}

}  // namespace

FrameDecoder::Layout::Layout(const dbc::Message& message) : plan(message) {
  for (const dbc::Signal& signal : message.signals) {
    steps.push_back({.bits = dbc::BitPlacement(signal, transport::most_j1939_bytes),
                     .conversion = dbc::DecimalConversion(signal),
                     .bytes = bytes_of(signal),
                     .multiplexor_bytes = multiplexor_bytes_of(message, signal)});
  }
}

std::vector<SignalValue> FrameDecoder::decode(const dbc::Message& message,
                                              std::span<const std::uint8_t> bytes) {
  const Layout& layout = layouts_.try_emplace(&message, message).first->second;
  bytes = bytes.first(std::min(bytes.size(), data_.size()));
  std::ranges::copy(bytes, data_.begin());
  if (used_ > bytes.size()) std::fill(data_.begin() + bytes.size(), data_.begin() + used_, std::uint8_t{0});
  used_ = bytes.size();
  std::vector<SignalValue> values;
  for (std::size_t i = 0; i < layout.steps.size(); ++i) {
    const Step& step = layout.steps[i];
    if (step.multiplexor_bytes > bytes.size() || !layout.plan.is_present(i, data_)) continue;
    SignalValue& value = values.emplace_back(SignalValue{.index = i});
    if (step.bytes > bytes.size()) continue;
    const std::uint64_t raw = step.bits.raw(data_.data());
    value.text = step.conversion.text(raw);
    if (!message.signals[i].values.empty()) value.name = dbc::value_name(message.signals[i], raw);
  }
  return values;
}

}  // namespace canhil::recordings
