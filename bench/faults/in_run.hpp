// The faults of a scenario in one run.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/faults/rule.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/truth_values.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::faults {

/// What the report of a run contains about a fault.
struct FaultReport {
  std::string name, kind;
  Stage stage = Stage::bus;
  std::uint64_t count = 0;         ///< see Tally::count
  std::vector<Trigger> windows{};  ///< each time that it was active; empty: it never began
};

/// Checks that each fault works with the bus and the target of `place`. Returns an Error of one line if a
/// fault does not work with them.
Result<void> check(std::span<const scenario::Fault> faults, const Place& place);

/// Checks that the faults that begin in the run can begin. Returns an Error of one line if the scenario has
/// no truth of a condition, or if no partner can command a fault.
Result<void> check_begins(const scenario::Scenario& scenario, bool has_partners);

class Faults final : public sensors::SensorFaults {
 public:
  /// `scenario`, `messages` (all messages of the bus) and `hands` must outlive this object.
  Faults(const scenario::Scenario& scenario, std::uint64_t run_index, std::span<const MessageInfo> messages,
         Place place = {}, RigControl* hands = nullptr);

  /// Whether a condition or a command may begin a fault.
  [[nodiscard]] bool begin_in_run() const { return begin_in_run_; }
  /// Begins the faults whose conditions hold at `t_us`, a time of the run. To be called in the order of time.
  void look(const world::Truths& truths, std::int64_t t_us);
  /// Begins or ends a fault that waits for commands. Returns whether it was not so before; a fault does not
  /// begin anew at the time at which it ended. Error, one phrase:
  /// there is no such fault.
  Result<bool> command(std::string_view name, bool begins, std::int64_t t_us);

  [[nodiscard]] bool act_on(const scenario::NodeSettings& node) const override;
  std::unique_ptr<sensors::Sensor> with_faults(std::unique_ptr<sensors::Sensor> sensor,
                                               const scenario::NodeSettings& node) override;
  /// The injectors of the faults that act between nodes and bus or on the target, in the order of the
  /// scenario.
  [[nodiscard]] std::span<const std::unique_ptr<Injector>> injectors() const { return injectors_; }

  [[nodiscard]] std::vector<FaultReport> reports() const;
  /// The sum over all faults.
  [[nodiscard]] Tally tally() const;

 private:
  [[nodiscard]] InRun in_run(std::size_t index);

  const scenario::Scenario& scenario_;
  std::uint64_t run_index_;
  std::span<const MessageInfo> messages_;
  Place place_;
  RigControl* rig_;
  std::vector<Tally> tallies_;               // one for each fault
  std::vector<Trigger> triggers_;            // one for each fault: the last
  std::vector<std::vector<Trigger>> ended_;  // one for each fault: those before
  bool begin_in_run_ = false;
  std::vector<std::unique_ptr<Injector>> injectors_;
};

}  // namespace canhil::faults
