// A node that the bench plays, as a scenario sees it: a table with a name. What stands in the table only the
// node's own file in bench/nodes knows.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "bench/scenario/schedule.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::scenario {

class NodeSettings;
class Section;

/// Whose truth a node samples: that of [truth], [glide] or [engagement]. The two of their own are nothing
/// without their nodes: where they are, those are needed.
enum class TruthOf : std::uint8_t { navigation, glide, engagement };

/// What an estimator that is aided has of a node's fixes.
struct Aid {
  double aiding = 0;  ///< the value of its parameter (EstimatorFacts::aided_by) that takes them
  /// The share that is lost at random, on purpose: waiting longer for them is no silence.
  double (*lost)(const NodeSettings& node) = nullptr;
};

/// A signal that a recording may lack, and what is sent in its place.
struct Assumed {
  std::string_view signal;
  double value = 0;
};

/// An increment, which adds up over more than one sample: "delta_theta_x_rad". A recording may have it as its
/// rate, "rate_x_radps", and a mapping play it so, "imu.rate.x".
struct Increment {
  std::string_view signal;
  std::string_view rate;
  std::string_view quantity;
};

/// What a scenario has to know of a kind of node.
struct NodeTable {
  std::string_view key;       ///< of its table: "gps"
  const MessageInfo& closes;  ///< its sample group, and comes at the DBC's cycle time
  TruthOf samples;
  /// Reads the table; what nobody asked for is found afterwards.
  NodeSettings (*read)(const NodeTable& table, Section& section) = nullptr;
  std::optional<Aid> aid{};
  // What else a recording of it may lack or have: of signals of its group, by their names in the DBC.
  std::span<const Assumed> assumed{};
  std::span<const Increment> increments{};
};

/// What a scenario says of a node that is on the bus. Never changes; copies of the scenario share it.
class NodeSettings {
 public:
  /// `own`: the node's own type, with a member `schedule`; of a recording also `recorded_from`.
  template <class Own>
  NodeSettings(const NodeTable& table, Own own)
      : table_(&table), is_recorded_(requires { own.recorded_from; }) {
    auto shared = std::make_shared<const Own>(std::move(own));
    schedule_ = &shared->schedule;
    own_ = std::move(shared);
  }

  [[nodiscard]] const NodeTable& table() const { return *table_; }
  /// What it sends was recorded: its own type is not that of a node that is played.
  [[nodiscard]] bool is_recorded() const { return is_recorded_; }
  [[nodiscard]] std::int64_t latency_us() const { return schedule_->latency_us; }
  [[nodiscard]] std::int64_t period_us() const {
    return schedule_->period_us.value_or(table_->closes.cycle_time_us);
  }

  /// What its table says; null: a node of another kind.
  template <class Own>
  [[nodiscard]] const Own* own() const {
    const auto* shared = std::any_cast<std::shared_ptr<const Own>>(&own_);
    return shared == nullptr ? nullptr : shared->get();
  }

 private:
  const NodeTable* table_;
  bool is_recorded_;
  const Schedule* schedule_;  // a part of what follows
  std::any own_;              // std::shared_ptr<const Own>
};

}  // namespace canhil::scenario
