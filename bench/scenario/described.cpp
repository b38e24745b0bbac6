#include "bench/scenario/described.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::scenario {
namespace {

thread_local Description* described_now = nullptr;

/// A value within limits.
double some_value(const Limits& limits) {
  if (!std::isfinite(limits.least)) return std::min(limits.most, 1.0);
  if (!limits.above_least) return limits.least;
  return std::isfinite(limits.most) ? (limits.least + limits.most) / 2 : limits.least + 1;
}

}  // namespace

Describing::Describing(Description& description) : before_(described_now) { described_now = &description; }
Describing::~Describing() { described_now = before_; }
Description* Describing::current() { return described_now; }

DescribedKey described_number(std::string_view type, const Limits& limits, std::optional<double> fallback) {
  return {.type = std::string(type),
          .limits = limits,
          .fallback = fallback && holds(limits, *fallback) ? fmt::format("{}", *fallback)
                                                           : "",  // the default depends on another key
          .required = !fallback,
          .sample = fmt::format("{}", fallback.value_or(some_value(limits)))};
}

}  // namespace canhil::scenario
