#include "bench/checks/not_finite.hpp"

#include <fmt/format.h>

#include <cmath>

namespace canhil::checks {

void NotFinite::take(std::int64_t t_us, double value, double other) {
  if (std::isfinite(value) && std::isfinite(other)) return;
  if (count_++ == 0) first_us_ = t_us;
}

std::string NotFinite::to_text(std::size_t of, std::string_view what, bool to_go) const {
  if (count_ == 0) return "";
  const double first_s = 1e-6 * static_cast<double>(to_go ? -first_us_ : first_us_);
  return fmt::format("{} of {} {} are not a number (NaN or infinite), first at {:g} s{}", count_, of, what,
                     first_s, to_go ? " to go" : "");
}

}  // namespace canhil::checks
