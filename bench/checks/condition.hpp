// The condition of a check (key `while`): an expression over what is true and what the target reports. The
// check then judges only what belongs to times at which it holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/rule.hpp"
#include "bench/scenario/expression.hpp"

namespace canhil::checks {

/// Beside true values and `t`, a condition has these values, in SI:
///   flag.MARK        1 if the newest answer that could report a mark did, otherwise 0
///   fault.FAULT      1 while a fault of the scenario acts (by time of transmission), otherwise 0
///   event.EVENT      1 once the request of an event was sent, otherwise 0
///   error.QUANTITY, sigma.QUANTITY, estimate.QUANTITY
///                    of the newest answer with the quantity
/// In the names of faults and events, characters other than letters and digits are written as _.
class Condition {
 public:
  /// Reads the key `while` of a check. Null: it has none, or a wrong one. `estimator`: whose flags and
  /// quantities are meant if several estimators have them.
  static std::shared_ptr<const Condition> read(scenario::Section& section,
                                               const scenario::CheckContext& context,
                                               std::string_view estimator);

  class InRun;
  /// Why it cannot be known whether it holds, such as a fault that did not strike; empty: it can.
  [[nodiscard]] std::string why_unknown(const Evidence& evidence) const;
  /// The quantities whose tracks it needs. `of_errors`: only those whose errors, and so whose truths, it
  /// needs.
  [[nodiscard]] std::vector<Subject> subjects(bool of_errors = false) const;
  /// The true values on which it depends.
  [[nodiscard]] std::span<const world::TruthValue* const> truths() const { return expression_.uses(); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  enum class What : std::uint8_t { flag, fault, event, error, sigma, estimate };
  struct Value {
    What what = What::flag;
    std::string name;  ///< of the mark or the fault
    std::string estimator{};
    const quantities::Quantity* quantity = nullptr;
    std::size_t event = 0;
  };

  explicit Condition(std::string text, scenario::Expression expression, std::vector<Value> values)
      : text_(std::move(text)), expression_(std::move(expression)), values_(std::move(values)) {}
  [[nodiscard]] std::vector<const Value*> used() const;

  std::string text_;
  scenario::Expression expression_;
  std::vector<Value> values_;  // that it may use
};

/// A condition in a run. The condition and the evidence must outlive it.
class Condition::InRun {
 public:
  InRun(const Condition& condition, const Evidence& evidence);
  /// Whether it holds at a time [us] of the run. Where one of its values is not known, it does not hold.
  [[nodiscard]] bool holds(std::int64_t t_us) const;

 private:
  /// What is known of a value.
  struct Known {
    Spool<std::int64_t> all{}, set{};          ///< flag: times of the answers that could, and did report it
    const quantities::Track* track = nullptr;  ///< null: it has none
  };
  [[nodiscard]] std::optional<double> value_at(std::size_t index, std::int64_t t_us) const;

  const Condition& condition_;
  const Evidence& evidence_;
  world::Truths truths_;
  std::map<std::size_t, Known> known_{};  // by index in Condition::values_
};

}  // namespace canhil::checks
