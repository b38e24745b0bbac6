#include "bench/plant/fmu/value.hpp"

#include <array>
#include <limits>

namespace canhil::plant::fmu {
namespace {

template <class T>
constexpr Range range() {
  return {static_cast<double>(std::numeric_limits<T>::lowest()),
          static_cast<double>(std::numeric_limits<T>::max())};
}

struct Facts {
  std::string_view name;
  bool integer = false;
  Range range{};
};

// In the order of Type. An enumeration has the range of FMI 2.0; FMI 3.0 permits that of Int64.
constexpr std::array<Facts, 13> types{{{"Float32", false, range<float>()},
                                       {"Float64", false, range<double>()},
                                       {"Int8", true, range<std::int8_t>()},
                                       {"UInt8", true, range<std::uint8_t>()},
                                       {"Int16", true, range<std::int16_t>()},
                                       {"UInt16", true, range<std::uint16_t>()},
                                       {"Int32", true, range<std::int32_t>()},
                                       {"UInt32", true, range<std::uint32_t>()},
                                       {"Int64", true, range<std::int64_t>()},
                                       {"UInt64", true, range<std::uint64_t>()},
                                       {"Boolean", false, {0, 1}},
                                       {"String"},
                                       {"Enumeration", true, range<std::int32_t>()}}};

const Facts& facts(Type type) { return types[static_cast<std::size_t>(type)]; }

}  // namespace

std::string_view name_of(Type type) { return facts(type).name; }
bool is_integer(Type type) { return facts(type).integer; }
Range range_of(Type type) { return facts(type).range; }

}  // namespace canhil::plant::fmu
