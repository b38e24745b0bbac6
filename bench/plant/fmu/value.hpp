// Values of FMU variables, and where they are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace canhil::plant::fmu {

/// The types of variables that the bench exchanges with an FMU. FMI 2.0 has four of them: its Real is
/// float64, its Integer int32.
enum class Type : std::uint8_t {
  float32,
  float64,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  boolean,
  string,
  enumeration
};

/// "Float64": the name of the type in FMI 3.0.
std::string_view name_of(Type type);
bool is_integer(Type type);
/// Least and largest value of a numeric type.
struct Range {
  double least = 0, most = 0;
};
Range range_of(Type type);

/// A number, an integer (also a boolean: 0 or 1, and an enumeration's value), or a text.
using Value = std::variant<double, std::int64_t, std::string>;

/// A variable as the functions of an FMU know it: its value reference, and the number of its elements, which
/// are in row-major order.
struct Place {
  std::string name;  ///< in messages
  std::uint32_t reference = 0;
  Type type = Type::float64;
  std::uint32_t count = 1;
};

/// The value of a variable before the simulation begins.
struct Preset {
  Place place{};
  std::vector<Value> values{};  ///< one for each element
};

/// All that is needed to start an FMU.
struct Setup {
  std::string fmu{};                 ///< its file, in messages
  std::int32_t version = 2;          ///< of the FMI: 2 or 3
  std::string folder{};              ///< where the FMU is unpacked
  std::string library{};             ///< path of the platform's binary
  std::string token{};               ///< guid (FMI 2.0) or instantiationToken (FMI 3.0)
  bool log = false;                  ///< the FMU's messages go to standard error
  double tolerance = 0;              ///< relative tolerance of the FMU's integration; 0: the FMU's own
  std::vector<Preset> structure{};   ///< structural parameters (FMI 3.0)
  std::vector<Preset> parameters{};  ///< and start values of other variables
  std::vector<Place> inputs{}, outputs{};
  std::vector<double> starts{};  ///< of the elements of all inputs
};

}  // namespace canhil::plant::fmu
