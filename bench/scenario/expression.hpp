// Expressions over the truth of a run, as scenarios and mappings write them: "atan2(velocity.east,
// velocity.north)".
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

#include "bench/world/truth_values.hpp"

namespace canhil::scenario {

class Section;
struct Scenario;

/// An expression over true values (world::truth_values(), and outputs of the plant: plant.NAME) in SI, and
/// `t`, the time of the run [s]. It has the operators and functions of muParser, and the constants `pi`,
/// `deg` (1 degree in rad) and `g` (standard gravity). Copies share one parser; several threads may use them.
class Expression {
 public:
  /// What is wrong in a text, and what was expected.
  struct Wrong {
    std::string what, expected;
  };
  /// Error: the syntax, or a name that is no true value. `further`: names of further values, which the caller
  /// knows.
  static tl::expected<Expression, Wrong> parse(std::string_view text,
                                               std::span<const std::string> further = {});

  /// The further value of an index of parse(); none: it has no value now.
  using Further = std::function<std::optional<double>(std::size_t index)>;
  /// The value at a time [us] of the run; none: one of its values has none at this time, or the result is not
  /// finite.
  [[nodiscard]] std::optional<double> at(const world::Truths& truths, std::int64_t t_us,
                                         const Further& further = {}) const;
  /// The true values in the expression.
  [[nodiscard]] std::span<const world::TruthValue* const> uses() const;
  /// The indices of its further values.
  [[nodiscard]] std::span<const std::size_t> uses_further() const;

 private:
  struct Parsed;
  explicit Expression(std::shared_ptr<Parsed> parsed) : parsed_(std::move(parsed)) {}

  std::shared_ptr<Parsed> parsed_;
};

/// Why a scenario has no truth of a value in the expression; empty: it has all.
std::string why_no_truth(const Scenario& scenario, const Expression& expression);

/// Reads the expression that a key holds. None: it is missing or wrong, and the error is reported.
std::optional<Expression> read_expression(Section& section, std::string_view key, std::string_view meaning);

}  // namespace canhil::scenario
