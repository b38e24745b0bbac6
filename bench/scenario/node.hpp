// A node of the bench as it appears in a scenario: a table with a name. Only the node's own file in
// bench/nodes reads the contents of the table.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/scenario/schedule.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::sensors {
struct Kind;
}

namespace canhil::scenario {

class NodeSettings;
class Section;

/// The properties of a node whose fixes an aided estimator uses.
struct Aid {
  double aiding = 0;  ///< value of the parameter EstimatorFacts::aided_by that selects these fixes
  /// The fraction of the fixes that the node loses at random, according to its settings. The longer wait for
  /// answers that results from these losses does not count as silence.
  double (*lost)(const NodeSettings& node) = nullptr;
};

/// An error of a sensor as its data sheet states it.
struct Stated {
  std::string_view name;  ///< ends in the unit: "gyro_misalignment_sigma_mrad"
  double value = 0;       ///< in this unit
};

/// Facts about a kind of node for scenarios.
struct NodeTable {
  std::string_view key;  ///< key of the node's table: "gps"
  /// The message of canhil.dbc that closes the node's sample group; null: canhil.dbc carries no such samples.
  const MessageInfo* closes = nullptr;
  std::int64_t period_us = 0;             ///< unless the table has the key `period_ms`
  const sensors::Kind* sensor = nullptr;  ///< what measures its samples
  /// An output that only the plant has which the node samples (PlantTable::shows); empty: the node samples
  /// the flight of the carrier. A scenario with a plant of its own tables must also have its nodes.
  std::string_view samples{};
  bool only_named = false;  ///< it is no table, but a [[sensor]] that a mapping declares
  /// Reads the table; unknown keys are detected afterwards.
  NodeSettings (*read)(const NodeTable& table, Section& section) = nullptr;
  std::optional<Aid> aid{};
  std::vector<Stated> (*data_sheet)(const NodeSettings& node) = nullptr;  ///< null: states nothing
};

/// The settings of a node on the bus. Immutable; copies of a scenario share the same settings.
class NodeSettings {
 public:
  /// `own`: the settings, in the node's own type. This type has a member `schedule` and, for a recording, a
  /// member `recorded_from`; for a program of the user, a member `program`.
  template <class Own>
  NodeSettings(const NodeTable& table, Own own)
      : table_(&table),
        is_recorded_(requires { own.recorded_from; }),
        is_program_(requires { own.program; }) {
    auto shared = std::make_shared<const Own>(std::move(own));
    schedule_ = &shared->schedule;
    own_ = std::move(shared);
  }

  [[nodiscard]] const NodeTable& table() const { return *table_; }
  /// Whether the node sends a recording. Its settings then have another type (own()) than for an emulated
  /// node.
  [[nodiscard]] bool is_recorded() const { return is_recorded_; }
  /// Whether a program of the user computes its samples. Its settings then have another type, too.
  [[nodiscard]] bool is_program() const { return is_program_; }
  /// Whether the bench's own model of its kind measures its samples, with the settings of this kind.
  [[nodiscard]] bool is_modelled() const { return !is_recorded_ && !is_program_; }
  /// The longest latency.
  [[nodiscard]] std::int64_t latency_us() const {
    return schedule_->latency_us + schedule_->latency_spread_us;
  }
  [[nodiscard]] std::int64_t period_us() const { return schedule_->period_us.value_or(table_->period_us); }

  /// The settings, if their type is `Own`; null: the settings have another type.
  template <class Own>
  [[nodiscard]] const Own* own() const {
    const auto* shared = std::any_cast<std::shared_ptr<const Own>>(&own_);
    return shared == nullptr ? nullptr : shared->get();
  }

 private:
  const NodeTable* table_;
  bool is_recorded_, is_program_;
  const Schedule* schedule_;  // points into the following member
  std::any own_;              // std::shared_ptr<const Own>
};

}  // namespace canhil::scenario
