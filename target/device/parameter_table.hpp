// An estimator's parameters as a table: range, default, when a parameter may change, and what it sets.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "messages/canhil.hpp"

namespace canhil::target {

/// The range, default and effect of a parameter, in the unit that its name states.
struct ParameterRange {
  double minimum = 0;
  double maximum = 0;
  bool whole = false;  ///< an integer
  double initial = 0;
  bool while_running = false;
  std::string_view meaning{};  ///< one sentence
};

/// Stores the values of the parameters in the unit of their name, and applies them to a `Tuning`.
template <class Tuning>
class ParameterTable {
 public:
  struct Row {
    messages::Parameter parameter;
    double initial;
    double minimum;
    double maximum;
    bool whole;  ///< an integer
    bool while_running;
    std::string_view meaning;  ///< for the reference (hil-bench reference)
    void (*apply)(Tuning&, double);
  };

  constexpr explicit ParameterTable(std::span<const Row> rows) : rows_(rows) {}

  /// Sets every parameter to its default.
  void reset(Tuning& tuning) {
    for (std::size_t i = 0; i < rows_.size(); ++i) take(tuning, i, rows_[i].initial);
  }

  messages::ParameterStatus set(Tuning& tuning, messages::Parameter parameter, double value, bool running) {
    const auto index = find(parameter);
    if (!index) return messages::ParameterStatus::unknown;
    const Row& row = rows_[*index];
    if (running && !row.while_running) return messages::ParameterStatus::wrong_state;
    if (!(value >= on_the_wire(row.minimum) && value <= on_the_wire(row.maximum)))
      return messages::ParameterStatus::out_of_range;  // NaN too
    if (row.whole && value != std::round(value)) return messages::ParameterStatus::out_of_range;
    take(tuning, *index, value);
    return messages::ParameterStatus::accepted;
  }

  [[nodiscard]] std::optional<double> get(messages::Parameter parameter) const {
    const auto index = find(parameter);
    return index ? std::optional(values_[*index]) : std::nullopt;
  }

  [[nodiscard]] std::optional<ParameterRange> range(messages::Parameter parameter) const {
    const auto index = find(parameter);
    if (!index) return std::nullopt;
    const Row& row = rows_[*index];
    return ParameterRange{.minimum = row.minimum,
                          .maximum = row.maximum,
                          .whole = row.whole,
                          .initial = row.initial,
                          .while_running = row.while_running,
                          .meaning = row.meaning};
  }

 private:
  static constexpr std::size_t capacity = 64;

  // Rounds a limit to float, as values on the bus are floats. Without this rounding, a minimum of 1e-9 would
  // refuse the value 1e-9, whose nearest float is smaller.
  static double on_the_wire(double limit) { return static_cast<double>(static_cast<float>(limit)); }

  [[nodiscard]] std::optional<std::size_t> find(messages::Parameter parameter) const {
    const auto found = std::ranges::find(rows_, parameter, &Row::parameter);
    if (found == rows_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - rows_.begin());
  }
  void take(Tuning& tuning, std::size_t index, double value) {
    values_[index] = value;
    rows_[index].apply(tuning, value);
  }

  std::span<const Row> rows_;
  std::array<double, capacity> values_{};
};

}  // namespace canhil::target
