// The values of an FMU's variables before the simulation begins: those of modelDescription.xml, and those of
// the table [plant.parameters] of a scenario.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/plant/fmu/description.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::plant::fmu {

/// A variable with the sizes of its array.
struct Sized {
  const DescribedVariable* variable = nullptr;
  std::vector<std::uint64_t> sizes{};  ///< empty: a scalar
  std::vector<Value> start{};          ///< one for each element, or none
  bool set = false;                    ///< the scenario sets the start

  [[nodiscard]] std::uint32_t count() const;
  /// "A", or "A[1,2]" for an element of an array, counted from 1.
  [[nodiscard]] std::string name(std::uint32_t element) const;
  [[nodiscard]] Place place() const;
};

/// The variables of an FMU with what the table [plant.parameters] sets, if there is one. `section` is the
/// table [plant]. Errors are reported to the sections: an unknown name, a value of a wrong type or out of
/// range, an array that is too large.
std::vector<Sized> read_presets(scenario::Section& section,
                                const std::optional<scenario::Section>& parameters,
                                const ModelDescription& description);

}  // namespace canhil::plant::fmu
