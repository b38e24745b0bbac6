// modelDescription.xml of an FMU, FMI 2.0 and 3.0: the part that a co-simulation needs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/plant/fmu/value.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant::fmu {

enum class Causality : std::uint8_t { input, output, parameter, structural_parameter, other };

/// Conversion of a unit to SI: si = factor * value + offset.
struct Conversion {
  double factor = 1, offset = 0;
  std::string si{};  ///< the SI unit, if the bench has a name for it; else empty
};

/// A size of an array: a constant, or the value of the structural parameter with a value reference.
struct Dimension {
  std::uint64_t size = 0;
  std::optional<std::uint32_t> from{};
};

struct DescribedVariable {
  std::string name;
  std::uint32_t reference = 0;
  Type type = Type::float64;
  Causality causality = Causality::other;
  bool settable = false;  ///< its value may be set before the simulation begins
  bool steps = false;     ///< it is discrete
  std::vector<Dimension> dimensions{};
  std::vector<Value> start{};  ///< empty: none; one value stands for all elements
  Conversion conversion{};
  std::optional<double> least{}, most{};                      ///< of a number
  std::vector<std::pair<std::string, std::int64_t>> items{};  ///< of an enumeration
};

struct ModelDescription {
  std::int32_t version = 2;       ///< of the FMI: 2 or 3
  std::string identifier;         ///< name of the binaries
  std::string token;              ///< guid or instantiationToken
  double tolerance = 0;           ///< 0: not given
  double step_s = 0;              ///< of the default experiment, or the internal step; 0: not given
  double internal_step_s = 0;     ///< 0: not given
  bool step_may_vary = false;     ///< canHandleVariableCommunicationStepSize
  bool once_per_process = false;  ///< canBeInstantiatedOnlyOncePerProcess
  std::vector<DescribedVariable> variables;
};

/// Reads the text of a modelDescription.xml. Variables that the bench cannot exchange (binary, clocked ones,
/// strings that are not parameters) are left out. Errors, one phrase each: not XML, another version of the
/// FMI, no co-simulation, input clocks, a wrong attribute.
Result<ModelDescription> read_description(std::string_view xml);

/// One value as XML (and TOML) writes it. Error: what was expected, "a whole number from 0 to 255".
Result<Value> read_value(std::string_view text, Type type);

}  // namespace canhil::plant::fmu
