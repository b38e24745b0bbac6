// What happened to a plant in a run: its outputs over time, and the commands that it got.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/spool/spool.hpp"

namespace canhil::world {

/// A command as it arrived.
struct Given {
  std::int64_t t_us = 0;       ///< arrival
  double value = 0;            ///< in SI
  std::int64_t cause_us = -1;  ///< time of validity of the sample that it answers; -1: it answers none
};

/// The commands of an input of a plant.
struct CommandRecord {
  std::string input;                 ///< its name
  std::int64_t delay_us = 0;         ///< from the arrival of a command to its effect
  std::int64_t step_us = 0;          ///< of the plant
  std::string unawaited{};           ///< a message that carries it and for which lockstep does not wait
  Spool<Given> given{};              ///< in order of arrival
  std::uint64_t invalid = 0;         ///< number of messages in which the command had no value
  Spool<std::int64_t> missing_us{};  ///< starts of the steps without a command, or with one that is too old
};

class PlantRecord {
 public:
  struct Column {
    std::string name;    ///< as a true value: "plant.rudder"
    bool turns = false;  ///< an angle: between two values it takes the shorter way
    bool steps = false;  ///< keeps a value until the next
  };
  explicit PlantRecord(std::vector<Column> columns) : columns_(std::move(columns)) {}

  std::vector<CommandRecord> commands{};
  double longest_step_s = 0;               ///< the longest time that a step took, by the wall clock
  std::optional<std::int64_t> ended_us{};  ///< when the motion came to its own end; the last values are there
  std::uint64_t late = 0;  ///< number of commands that came after the time from which they should have acted

  /// Adds the values at a time later than all others.
  void add(std::int64_t t_us, std::span<const double> values);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// The index of a column; none: there is no such column.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  /// The times of the values [us], ascending.
  [[nodiscard]] const Spool<std::int64_t>& times_us() const { return times_us_; }
  /// The value at the time times_us()[index].
  [[nodiscard]] double value(std::size_t column, std::size_t index) const {
    return values_[index * columns_.size() + column];
  }
  /// The index of the values at exactly this time; none: there are none.
  [[nodiscard]] std::optional<std::size_t> row(std::int64_t t_us) const;
  /// The value at a time between the first and the last, interpolated on a straight line; none: any other
  /// time.
  [[nodiscard]] std::optional<double> at(std::size_t column, std::int64_t t_us) const;

 private:
  std::vector<Column> columns_;
  Spool<std::int64_t> times_us_;
  Spool<double> values_;
};

/// The records of the plants of a run.
using PlantRecords = std::vector<const PlantRecord*>;

/// The record of the plant that commands steer; null: none of them is steered.
inline const PlantRecord* steered(const PlantRecords& plants) {
  const auto found = std::ranges::find_if(plants, [](const auto* one) { return !one->commands.empty(); });
  return found == plants.end() ? nullptr : *found;
}

/// Columns of a record, looked up once by their names.
template <std::size_t count>
class PlantColumns {
 public:
  using Names = std::array<std::string_view, count>;

  /// Of the first record that has all these columns; none: no record has them.
  static std::optional<PlantColumns> find(const PlantRecords& plants, const Names& names) {
    for (const PlantRecord* record : plants) {
      PlantColumns found(*record);
      std::size_t known = 0;
      for (; known < count; ++known) {
        const auto column = record->find(names[known]);
        if (!column) break;
        found.columns_[known] = *column;
      }
      if (known == count) return found;
    }
    return std::nullopt;
  }

  /// The values at a time, as PlantRecord::at().
  [[nodiscard]] std::optional<std::array<double, count>> at(std::int64_t t_us) const {
    std::array<double, count> values{};
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = record_->at(columns_[i], t_us);
      if (!value) return std::nullopt;
      values[i] = *value;
    }
    return values;
  }
  /// The values at a row of record().
  [[nodiscard]] std::array<double, count> of_row(std::size_t row) const {
    std::array<double, count> values{};
    for (std::size_t i = 0; i < count; ++i) values[i] = record_->value(columns_[i], row);
    return values;
  }
  [[nodiscard]] const PlantRecord& record() const { return *record_; }

 private:
  explicit PlantColumns(const PlantRecord& record) : record_(&record) {}

  const PlantRecord* record_;
  std::array<std::size_t, count> columns_{};
};

}  // namespace canhil::world
