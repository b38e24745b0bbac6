#include "dbc/wire/unrounded.hpp"

#include <cstring>

#include "dbc/wire/quantise.hpp"

namespace canhil::wire {

void carry_unrounded(const void* message, std::span<const ScaledMember> members, Frame& frame) {
  std::uint8_t* to = frame.data.data() + frame.size;
  for (const ScaledMember& member : members) {
    double value = 0;
    std::memcpy(&value, static_cast<const std::byte*>(message) + member.offset, sizeof value);
    value = clamped(value, member.lowest, member.highest);
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
  }
  frame.unrounded = true;
}

void take_unrounded(const Frame& frame, std::span<const ScaledMember> members, void* message) {
  const std::uint8_t* from = frame.data.data() + frame.size;
  for (const ScaledMember& member : members) {
    std::memcpy(static_cast<std::byte*>(message) + member.offset, from, sizeof(double));
    from += sizeof(double);
  }
}

}  // namespace canhil::wire
