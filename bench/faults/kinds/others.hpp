// Frames that no node of the scenario sends.
#pragma once

#include <optional>

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// A frame with an unused id and a random payload.
struct Stranger {
  static constexpr std::string_view kind = "stranger";
  static constexpr std::string_view meaning =
      "The bench sends extra frames with an unused id and random bytes.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  std::int64_t period_us = 0;
  std::uint32_t id = 0;
  static Stranger read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// Frames of the highest priority: they win arbitration against all other frames.
struct Flood {
  static constexpr std::string_view kind = "flood";
  static constexpr std::string_view meaning = "The bench sends extra frames of the highest priority.";
  static constexpr Stage stage = Stage::bus;
  When when{};
  std::optional<std::int64_t> period_us{};
  double load = 0;  ///< without `period_us`: the fraction of the bit rate that the frames occupy
  static Flood read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
