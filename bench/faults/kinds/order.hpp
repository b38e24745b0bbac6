// Frames that reach the bus later than they were sent.
#pragma once

#include "bench/faults/kinds/frames.hpp"

namespace canhil::faults {

/// Delayed by a time; unaffected frames overtake it.
struct Delayed : Frames {
  static constexpr std::string_view kind = "delayed";
  std::int64_t by_us = 0;
  static Delayed read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// Sent after the next frame of its message.
struct Reordered : Frames {
  static constexpr std::string_view kind = "reordered";
  static Reordered read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
