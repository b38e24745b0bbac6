// Samples whose content is wrong, although each number by itself is plausible.
#pragma once

#include "bench/faults/read.hpp"
#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// Two values of a sample are swapped.
struct Swapped {
  static constexpr std::string_view kind = "swapped";
  static constexpr std::string_view meaning = "The values of two quantities of a node are exchanged.";
  static constexpr Stage stage = Stage::sensor;
  Measured one{}, other{};
  std::string text{};
  When when{};
  static Swapped read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string subject() const { return text; }
  [[nodiscard]] bool acts_on(const scenario::NodeTable& table) const { return one.sensor->key == table.key; }
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

/// The sample is flagged invalid.
struct Invalid {
  static constexpr std::string_view kind = "invalid";
  static constexpr std::string_view meaning = "The validity flags of the sample are set to invalid.";
  static constexpr Stage stage = Stage::sensor;
  const sensors::Kind* of = nullptr;
  std::uint32_t flags = 0;  ///< bit i: flag i is set to invalid
  std::string text{};
  When when{};
  static Invalid read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string subject() const { return text; }
  [[nodiscard]] bool acts_on(const scenario::NodeTable& table) const { return of->key == table.key; }
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const;
};

}  // namespace canhil::faults
