// Faults that the driver of a CAN controller reports, and outages of the interface itself.
#pragma once

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// Periodic error frames, which report protocol errors that a controller would have detected.
struct ErrorFrames {
  static constexpr std::string_view kind = "error_frame";
  static constexpr std::string_view meaning = "The driver reports an error on the bus every `period_ms`.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  std::int64_t period_us = 0;
  static ErrorFrames read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The controller becomes error passive and, after the fault, error active again.
struct ErrorPassive {
  static constexpr std::string_view kind = "error_passive";
  static constexpr std::string_view meaning =
      "The driver reports that the controller is error passive and, after `for_s`, that the controller is "
      "error active again. Needs `for_s`.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  static ErrorPassive read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The controller goes bus-off and, after the fault, is restarted.
struct BusOff {
  static constexpr std::string_view kind = "bus_off";
  static constexpr std::string_view meaning =
      "The driver reports that the controller is bus-off and, after `for_s`, that the controller has "
      "restarted. Needs `for_s`.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  static BusOff read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The interface is set down and, after the fault, up again.
struct InterfaceDown {
  static constexpr std::string_view kind = "interface_down";
  static constexpr std::string_view meaning =
      "The interface is set down and, after `for_s`, set up again. Needs `for_s`.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  static InterfaceDown read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
