// Times in a section, in whole microseconds; and functions of a section that do not access the file.
#include <fmt/format.h>

#include <cmath>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

constexpr double longest_us = 1e11;  // more than a day

}  // namespace

std::int64_t Section::time_us(const Key& key, Limits limits, std::optional<double> fallback) {
  const double us = 1e6 * number(key, limits, fallback);
  if (std::abs(us) > longest_us) {
    reject(key.name, "is too long a time", fmt::format("at most {} s", 1e-6 * longest_us));
    return 0;
  }
  const double whole = std::round(us);
  // A decimal fraction is not exact in binary. The relative error is 1e-16, which is 1e-5 us for a time of
  // one day.
  if (std::abs(us - whole) > 1e-3) reject(key.name, "is not whole in microseconds", "a multiple of 1 us");
  return static_cast<std::int64_t>(whole);
}

std::optional<std::pair<std::int64_t, std::int64_t>> Section::optional_interval_us(const Key& key,
                                                                                   Limits limits) {
  describe_optional(key, interval_type, limits);
  optional(key.name);
  if (!has(key.name)) return std::nullopt;
  const auto [from, to] = interval(key, limits);
  return std::pair{std::llround(from * 1e6), std::llround(to * 1e6)};
}

std::optional<double> Section::optional_number(const Key& key, Limits limits) {
  describe_optional(key, "number", limits);
  if (has(key.name)) return number(key, limits);
  optional(key.name);
  return std::nullopt;
}

std::optional<std::int64_t> Section::optional_time_us(const Key& key, Limits limits) {
  describe_optional(key, "number", limits);
  if (has(key.name)) return time_us(key, limits);
  optional(key.name);
  return std::nullopt;
}

std::optional<Section> Section::optional_table(const Key& key) {
  if (has(key.name)) return table(key);
  optional(key.name);
  return std::nullopt;
}

void Section::refuse(std::string_view key, std::string_view what, std::string_view expected) {
  if (has(key)) reject(key, what, expected);
  optional(key);
}

}  // namespace canhil::scenario
