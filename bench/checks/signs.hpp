// Signs of trouble that a target reports: marked answers, error bits of its heartbeat, its counters. The
// checks that judge the response to a fault look for these signs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"

namespace canhil::checks {

/// One kind of sign from one source.
struct Sign {
  std::string_view name;                      ///< "coasting"
  std::string_view by;                        ///< "an answer", "a heartbeat", "a counter"
  std::vector<std::int64_t> t_us{};           ///< ascending; for answers, the times of their causes
  [[nodiscard]] std::string to_text() const;  ///< "coasting in an answer"
};

/// All signs of a run: marks in the answers of `estimators`, error bits and counters.
std::vector<Sign> signs_in(const Observations& seen,
                           std::span<const estimators::Estimator* const> estimators);

/// The names of all possible signs: error bits, counters, and marks of the estimators. The mark "answers" and
/// the marks in Estimator::plain_marks are not signs.
std::vector<std::string> sign_names(std::span<const estimators::Estimator* const> estimators);

/// A sign that appears within this time before a fault is not attributed to the fault.
inline constexpr std::int64_t just_before_us = 5'000'000;

/// Whether a sign appeared just before a time, in [onset - just_before_us, onset).
bool was_there_before(const Sign& sign, std::int64_t onset_us);
/// Removes the signs that appeared just before a time.
std::vector<Sign> new_since(std::vector<Sign> signs, std::int64_t onset_us);

/// Whether a target can show any sign: a mapped target may have none.
bool can_show_signs(const Observations& seen, std::span<const estimators::Estimator* const> estimators);

struct SignAt {
  std::int64_t t_us = 0;
  std::string text;
};
/// The first sign in [from, to]; none: no sign in this interval.
std::optional<SignAt> first_in(std::span<const Sign> signs, std::int64_t from_us, std::int64_t to_us);
/// The last sign after a time; none: no sign after it.
std::optional<SignAt> last_after(std::span<const Sign> signs, std::int64_t t_us);

}  // namespace canhil::checks
