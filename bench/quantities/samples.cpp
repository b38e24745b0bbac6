#include "bench/quantities/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace canhil::quantities {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void append(std::vector<std::uint8_t>& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
}

double number_at(std::span<const std::uint8_t> bytes, std::size_t index) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{bytes[8 * index + i]} << (8 * i);
  return std::bit_cast<double>(bits);
}

}  // namespace

bool has(const Layout& layout, const Quantity& quantity) {
  return std::ranges::find(layout.kept, &quantity) != layout.kept.end() ||
         std::ranges::find(layout.derived, &quantity, &Derived::quantity) != layout.derived.end();
}

std::string names(const Layout& layout) {
  std::string names;
  for (const Quantity* quantity : layout.kept) {
    if (!names.empty()) names += ' ';
    names += quantity->name;
  }
  return names;
}

void Samples::add(std::int64_t t_us, std::span<const double> values) {
  assert(values.size() == layout_->kept.size());
  t_us_.push_back(t_us);
  values_.insert(values_.end(), values.begin(), values.end());
}

std::span<const double> Samples::values(std::size_t index) const {
  const std::size_t width = layout_->kept.size();
  return std::span(values_).subspan(index * width, width);
}

double Samples::value(std::size_t index, const Quantity& quantity) const {
  const auto& kept = layout_->kept;
  if (const auto found = std::ranges::find(kept, &quantity); found != kept.end())
    return values(index)[static_cast<std::size_t>(found - kept.begin())];
  const auto derived = std::ranges::find(layout_->derived, &quantity, &Derived::quantity);
  return derived == layout_->derived.end() ? nan : derived->of(*this, index);
}

double infinite_if_nan(double normalised) {
  return std::isnan(normalised) ? std::numeric_limits<double>::infinity() : normalised;
}

std::vector<std::uint8_t> encode(const Samples& samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size() * (1 + samples.layout().kept.size()) * sizeof(double));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    append(bytes, static_cast<double>(samples.times()[i]) / 1e6);
    for (const double value : samples.values(i)) append(bytes, value);
  }
  return bytes;
}

Result<Samples> decode(std::span<const std::uint8_t> bytes, const Layout& layout) {
  constexpr double latest_s = 1e9;
  const std::size_t width = 1 + layout.kept.size(), size = width * sizeof(double);
  if (bytes.size() % size != 0)
    return failure(fmt::format("has {} bytes of samples of {} each", bytes.size(), size));
  Samples samples(layout);
  std::vector<double> values(width - 1);
  for (std::size_t i = 0; i < bytes.size() / size; ++i) {
    for (std::size_t index = 1; index < width; ++index)
      values[index - 1] = number_at(bytes, i * width + index);
    const double t_s = number_at(bytes, i * width);
    if (!(std::abs(t_s) <= latest_s)) return failure(fmt::format("has a sample at {} s", t_s));
    samples.add(std::llround(t_s * 1e6), values);
  }
  return samples;
}

}  // namespace canhil::quantities
