// Shared by [[check]] and [[metric]]: a rule of one of several kinds, selected by `kind`, and times within a
// run.
//
// A rule is a std::variant of structs, each with a constant `kind`.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bench/scenario/checks.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {

/// The names of all kinds, in the order of the variant.
template <class Rule>
std::vector<std::string> kinds() {
  return []<std::size_t... i>(std::index_sequence<i...>) {
    return std::vector<std::string>{std::string(std::variant_alternative_t<i, Rule>::kind)...};
  }
  (std::make_index_sequence<std::variant_size_v<Rule>>{});
}

template <class Rule>
std::string_view kind_of(const Rule& rule) {
  return std::visit([](const auto& alternative) { return alternative.kind; }, rule);
}

/// Default-constructs the rule of this kind and passes it to `read`; for an unknown kind, returns a
/// default-constructed rule of the first kind.
template <class Rule, class Read>
Rule read_rule(std::string_view kind, Read&& read) {
  Rule rule;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (void)((std::variant_alternative_t<i, Rule>::kind == kind &&
            (rule = read(std::variant_alternative_t<i, Rule>{}), true)) ||
           ...);
  }
  (std::make_index_sequence<std::variant_size_v<Rule>>{});
  return rule;
}

/// Rejects a key with a time after the end of the run.
void expect_within_run(Section& section, std::string_view key, std::int64_t t_us, std::int64_t duration_us);

/// A time up to the end of the run.
std::int64_t read_time(Section& section, const Key& key, Limits limits, std::int64_t duration_us);

/// `from_s` and `to_s`; default: the whole run.
Window read_window(Section& section, std::int64_t duration_us);

/// Rejects a lower limit that is above the upper limit.
template <class Value>
void expect_ordered(Section& section, std::string_view least_key, const std::optional<Value>& least,
                    std::string_view most_key, const std::optional<Value>& most) {
  if (least && most && *least > *most)
    section.reject(least_key, fmt::format("is more than {}", most_key), "a lower limit below the upper one");
}

}  // namespace canhil::scenario
