// Decodes single frames for output: the values as text, and the signals that a short frame lacks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/parser/decimal.hpp"
#include "dbc/parser/plan.hpp"
#include "dbc/transport/j1939.hpp"

namespace canhil::recordings {

/// A signal of a frame.
struct SignalValue {
  std::size_t index = 0;  ///< index in Message::signals
  /// The value in the unit of the signal, as dbc::DecimalConversion writes it; empty: the frame is too short
  /// for this signal.
  std::string text{};
  std::string_view name{};  ///< from the value table; empty: the value has no name
};

/// Decodes frames of any size. The signals that lie completely inside a frame have a value; the other ones
/// are missing. Signals that the multiplexors do not select, or whose multiplexor is missing, are left out.
class FrameDecoder {
 public:
  /// Decodes the bytes of a frame, or of several frames put together, of `message`, which must outlive this
  /// object. The values are in the order of the DBC.
  std::vector<SignalValue> decode(const dbc::Message& message, std::span<const std::uint8_t> bytes);

 private:
  struct Step {
    dbc::BitPlacement bits;
    dbc::DecimalConversion conversion;
    unsigned bytes;              ///< so many bytes must a frame have that contains the signal
    unsigned multiplexor_bytes;  ///< and so many for the multiplexors above it
  };
  struct Layout {
    explicit Layout(const dbc::Message& message);
    dbc::MessagePlan plan;
    std::vector<Step> steps;
  };
  std::map<const dbc::Message*, Layout> layouts_;
  std::array<std::uint8_t, transport::most_j1939_bytes> data_{};  // the message, then zeros
  std::size_t used_ = 0;
};

}  // namespace canhil::recordings
