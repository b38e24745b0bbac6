// Frames with right values but wrong protection.
#pragma once

#include "bench/faults/kinds/frames.hpp"

namespace canhil::faults {

/// The CRC is wrong.
struct WrongCrc : Frames {
  static constexpr std::string_view kind = "wrong_crc";
  static constexpr std::string_view meaning = "The payload is right, the CRC is not.";
  static WrongCrc read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// All affected frames have the counter of the first affected frame; the CRC is right.
struct CounterStuck : Frames {
  static constexpr std::string_view kind = "counter_stuck";
  static constexpr std::string_view meaning =
      "The counter keeps the value of the first frame that the fault affects. The CRC is right.";
  static CounterStuck read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The counter is too high; the CRC is right.
struct CounterJump : Frames {
  static constexpr std::string_view kind = "counter_jump";
  static constexpr std::string_view meaning = "The counter is too high by `by`. The CRC is right.";
  std::int64_t by = 1;
  static CounterJump read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
