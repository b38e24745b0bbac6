// Frames that reach the bus later than their node sent them.
#pragma once

#include "bench/faults/kinds/frames.hpp"

namespace canhil::faults {

/// The frame is delayed by a constant time; frames that are not affected overtake it.
struct Delayed : Frames {
  static constexpr std::string_view kind = "delayed";
  static constexpr std::string_view meaning = "The frame is sent later.";
  std::int64_t by_us = 0;
  static Delayed read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The frame is sent after the next frame of the same message.
struct Reordered : Frames {
  static constexpr std::string_view kind = "reordered";
  static constexpr std::string_view meaning = "The frame is sent after the next frame of the same message.";
  static Reordered read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
