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
#include "dbc/wire/result.hpp"

namespace canhil::faults {

/// The report of a fault.
struct FaultReport {
  std::string name, kind;
  Stage stage = Stage::bus;
  std::int64_t from_us = 0, to_us = 0;
  std::uint64_t count = 0;  ///< see Tally
};

/// Checks that each fault works with the bus and the target of `place`. Error: one line; a fault does not.
Result<void> check(std::span<const scenario::Fault> faults, const Place& place);

class Faults final : public nodes::NodeFaults {
 public:
  /// `scenario`, `messages` (of the bus) and `hands` must outlive it.
  Faults(const scenario::Scenario& scenario, std::uint64_t run_index, std::span<const MessageInfo> messages,
         Place place = {}, RigControl* hands = nullptr);

  std::unique_ptr<nodes::Node> with_faults(std::unique_ptr<nodes::Node> node,
                                           const scenario::NodeSettings& settings) override;
  /// The faults between nodes and bus, in the order of the scenario.
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
  std::vector<Tally> tallies_;  // one for each fault
  std::vector<std::unique_ptr<Injector>> injectors_;
};

}  // namespace canhil::faults
