// Frames with correct values but a wrong counter or CRC.
#pragma once

#include <map>
#include <memory>

#include "bench/faults/kinds/frames.hpp"

namespace canhil::protection {
class Protection;
}

namespace canhil::faults {

/// Messages with a counter or a checksum. Their places and rules come from the DBC of the bus.
struct ProtectedFrames : Frames {
  std::map<const MessageInfo*, std::shared_ptr<const protection::Protection>> protection{};
};

/// The CRC is wrong.
struct WrongCrc : ProtectedFrames {
  static constexpr std::string_view kind = "wrong_crc";
  static constexpr std::string_view meaning = "The payload is correct, the CRC is wrong.";
  static WrongCrc read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// All affected frames have the counter of the first affected frame; the CRC is correct.
struct CounterStuck : ProtectedFrames {
  static constexpr std::string_view kind = "counter_stuck";
  static constexpr std::string_view meaning =
      "The counter keeps the value of the first frame that the fault affects. The CRC is correct.";
  static CounterStuck read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The counter is too high; the CRC is correct.
struct CounterJump : ProtectedFrames {
  static constexpr std::string_view kind = "counter_jump";
  static constexpr std::string_view meaning = "The counter is too high by `by`. The CRC is correct.";
  std::int64_t by = 1;
  static CounterJump read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
