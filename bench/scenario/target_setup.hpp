// [target], or [[target]] once for each estimator that the target runs at the same time: what the bench tells
// it before the start.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/scenario/contract.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::scenario {

class Section;

/// 1-sigma uncertainty the target is told of its initial state (TargetInit*).
struct InitialSigma {
  double velocity = 0;  ///< of each component [m/s]
  double tilt = 0;      ///< of the misalignments about north and east [rad]
  double heading = 0;   ///< of the misalignment about down [rad]
  double position = 0;  ///< of each component [m]
};

/// One ParamSet. Parameters go over the bus in the unit of their name, so they stay in it here.
struct Parameter {
  std::string name;
  double value = 0;
  std::string where{};  ///< in the scenario, for messages: "my.toml:31: key 'target.parameters.h2_case'"
};

/// Of a target that is told nothing at the start (Contract::foreign).
struct OwnStart {
  std::int64_t settle_us = 0;   ///< from its start, or the bench's, to the first sample
  std::int64_t silence_us = 0;  ///< after which it counts as gone
  std::string before, after;    ///< commands of a shell, around the run: power, relays; empty: none
};

struct TargetSetup {
  std::string estimator;          ///< a name of the DBC's value table Estimator
  std::string algorithm;          ///< a name of Algorithm
  std::string algorithm_where{};  ///< in the scenario, for messages: "my.toml:9: key 'target.algorithm'"
  InitialSigma initial_sigma;
  std::optional<world::InitialErrorModel> initial_error{};  ///< its own in place of the scenario's
  std::vector<Parameter> parameters;                        ///< in the DBC's order
  std::optional<OwnStart> own_start{};                      ///< none: by the contract's handshake
};

/// Every estimator of the target, at least one, none of them twice.
std::vector<TargetSetup> read_targets(Section& root, const DbcVocabulary& contract);

}  // namespace canhil::scenario
