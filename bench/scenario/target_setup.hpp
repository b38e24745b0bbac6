// Reads the configuration of the target before the start: [target] or, if the target runs several estimators
// at the same time, one [[target]] for each estimator.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/scenario/contract.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::scenario {

class Section;

/// The 1-sigma uncertainty of the initial state. The target receives this uncertainty and the state
/// (TargetInit*).
struct InitialSigma {
  double velocity = 0;  ///< each component [m/s]
  double tilt = 0;      ///< misalignments about north and east [rad]
  double heading = 0;   ///< misalignment about down [rad]
  double position = 0;  ///< each component [m]
};

/// One ParamSet. The value stays in the unit that the parameter's name contains, because the value is sent in
/// this unit.
struct Parameter {
  std::string name;
  double value = 0;
  std::string where{};  ///< in the scenario, for messages: "my.toml:31: key 'target.parameters.h2_case'"
  bool stated = false;  ///< not in the scenario, but in a sensor's data sheet: a target may not know it
};

/// Settings for a target that receives nothing at the start (Binding::handshake).
struct OwnStart {
  std::int64_t settle_us = 0;   ///< time from the start of target or bench to the first sample
  std::int64_t silence_us = 0;  ///< a target that is silent for longer counts as gone
  std::string before, after;    ///< shell commands around the run: power, relays; empty: none
};

struct TargetSetup {
  std::string estimator;          ///< a name of the DBC's value table Estimator
  std::string algorithm;          ///< a name of the DBC's value table Algorithm
  std::string algorithm_where{};  ///< in the scenario, for messages: "my.toml:9: key 'target.algorithm'"
  InitialSigma initial_sigma;
  std::optional<world::InitialErrorModel> initial_error{};  ///< replaces the scenario's initial_error
  std::vector<Parameter> parameters;                        ///< in the DBC's order
  bool data_sheets_withheld = false;    ///< the target is not sent what the sensors' data sheets state
  std::optional<OwnStart> own_start{};  ///< none: the handshake configures the target
};

class NodeSettings;
/// Adds the parameters that the data sheets of the sensors state and the scenario does not set.
void add_stated(std::vector<TargetSetup>& targets, std::span<const NodeSettings> nodes,
                const DbcVocabulary& contract);

/// All estimators of the target, or all mapped targets: at least one, without duplicates.
std::vector<TargetSetup> read_targets(Section& root, const DbcVocabulary& contract);

}  // namespace canhil::scenario
