#include "bench/world/plant_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::world {

void PlantRecord::add(std::int64_t t_us, std::span<const double> values) {
  times_us_.push_back(t_us);
  for (const double value : values) values_.push_back(value);
}

std::optional<std::size_t> PlantRecord::find(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name, &Column::name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::optional<std::size_t> PlantRecord::row(std::int64_t t_us) const {
  const auto found = std::ranges::lower_bound(times_us_, t_us);
  if (found == times_us_.end() || *found != t_us) return std::nullopt;
  return static_cast<std::size_t>(found - times_us_.begin());
}

std::optional<double> PlantRecord::at(std::size_t column, std::int64_t t_us) const {
  const auto after = std::ranges::upper_bound(times_us_, t_us);
  if (after == times_us_.begin()) return std::nullopt;
  const auto index = static_cast<std::size_t>(after - times_us_.begin() - 1);
  const double before = value(column, index);
  if (times_us_[index] == t_us) return before;
  if (after == times_us_.end()) return std::nullopt;
  if (columns_[column].steps) return before;
  const double share = static_cast<double>(t_us - times_us_[index]) /
                       static_cast<double>(times_us_[index + 1] - times_us_[index]);
  double gain = value(column, index + 1) - before;
  if (columns_[column].turns) gain = std::remainder(gain, 2 * std::numbers::pi);
  return before + share * gain;
}

}  // namespace canhil::world
