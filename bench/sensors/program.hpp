// A sensor that a program of the user computes: any kind of sensor whose table has the key `command`. The
// program gets true values and gives those of a sample (docs/programs.md).
#pragma once

#include <vector>

#include "bench/processes/conversation.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/sensors/kind.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::sensors {

/// The settings of a sensor whose table has the key `command`.
struct ProgramSettings {
  scenario::Schedule schedule{};
  SampleLoss loss{};
  processes::ProgramSettings program{};
  processes::program_protocol::Declared declared{};
  std::vector<const world::TruthValue*> inputs{};  ///< in the order of the program's inputs
  std::vector<Place> outputs{};                    ///< in the order of the program's outputs
};

/// Reads the table of a sensor of any kind that a program computes. Errors are reported to the section: those
/// of its keys, and a program that cannot be started or whose inputs and outputs are not those of the sensor.
NodeSettings read_program(const NodeTable& table, Section& section);

std::unique_ptr<Sensor> make_program(const NodeSettings& node, const Run& run);

/// Why a scenario has no truth of what a sensor measures; empty: it has.
std::string why_no_truth(const NodeSettings& node, const scenario::Scenario& scenario);

}  // namespace canhil::sensors
