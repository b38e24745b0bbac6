// How a target says that something is wrong: answers that are no plain ones, errors of its heartbeat, its
// counters. Who looks for the response to a fault looks for these.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"

namespace canhil::checks {

/// One thing that it says, in one way.
struct Sign {
  std::string_view name;                      ///< "coasting"
  std::string_view by;                        ///< "an answer", "a heartbeat", "a counter"
  std::vector<std::int64_t> t_us{};           ///< ascending; of answers, the times of their causes
  [[nodiscard]] std::string to_text() const;  ///< "coasting in an answer"
};

/// All that a run had, of the estimators that answered.
std::vector<Sign> signs_in(const Observations& seen,
                           std::span<const estimators::Estimator* const> estimators);

/// The names of all that there may be: marks of these estimators but the plain ones, errors, counters.
std::vector<std::string> sign_names(std::span<const estimators::Estimator* const> estimators);

/// What is said so long before a fault, and during it, is not said of it.
inline constexpr std::int64_t just_before_us = 5'000'000;

/// Leaves out the signs that were given just before a time, in [onset - just_before_us, onset).
std::vector<Sign> new_since(std::vector<Sign> signs, std::int64_t onset_us);

struct SignAt {
  std::int64_t t_us = 0;
  std::string text;
};
/// The first of all in [from, to]; none: there is none.
std::optional<SignAt> first_in(std::span<const Sign> signs, std::int64_t from_us, std::int64_t to_us);
/// The last of all after a time; none: there is none.
std::optional<SignAt> last_after(std::span<const Sign> signs, std::int64_t t_us);

}  // namespace canhil::checks
