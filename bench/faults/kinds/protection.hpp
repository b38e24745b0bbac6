// Frames with right values but wrong protection.
#pragma once

#include "bench/faults/kinds/frames.hpp"

namespace canhil::faults {

/// The CRC is wrong.
struct WrongCrc : Frames {
  static constexpr std::string_view kind = "wrong_crc";
  static WrongCrc read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The counter stays at that of the first affected frame; the CRC is right.
struct CounterStuck : Frames {
  static constexpr std::string_view kind = "counter_stuck";
  static CounterStuck read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The counter is too high; the CRC is right.
struct CounterJump : Frames {
  static constexpr std::string_view kind = "counter_jump";
  std::int64_t by = 1;
  static CounterJump read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
