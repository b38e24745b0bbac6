#include "bench/mapping/range.hpp"

#include <algorithm>

namespace canhil::mapping {

std::optional<std::pair<double, double>> physical_range(const dbc::Signal& signal) {
  const auto between = [&](double a, double b) {
    const double low = a * signal.scale + signal.offset, high = b * signal.scale + signal.offset;
    return std::pair(std::min(low, high), std::max(low, high));
  };
  if (signal.is_float()) {
    const dbc::RealRange range = dbc::real_range(signal);
    return between(range.lowest, range.highest);
  }
  const auto range = dbc::raw_range(signal);
  if (!range) return std::nullopt;
  const auto number = [&](std::int64_t bits) {
    return signal.is_signed() ? static_cast<double>(bits)
                              : static_cast<double>(static_cast<std::uint64_t>(bits));
  };
  return between(number(range->lowest), number(range->highest));
}

}  // namespace canhil::mapping
