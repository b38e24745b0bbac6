// The guest that tests/controller/run.sh starts: can0 is the interface of the target, can1 that of the bench.
#pragma once

#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {

/// Takes both interfaces down and up again, as `ip link set can0 up type can OPTIONS` has it.
void set_up(const std::string& can0_options, const std::string& can1_options);

/// Loads the wire that can fail, if it is not, and sets up both interfaces at 1 Mbit/s.
/// Options of can0, of can1: besides the bit rate.
void set_up_on_wire(const std::string& can0_options = "", const std::string& can1_options = "");

/// Sets the interface up or down at once, as `ip link set INTERFACE up` does.
void set_interface(const std::string& interface, bool up);

/// Waits, half a minute at most, until the interface has a carrier or none: a controller that is bus-off has
/// none.
void await_carrier(const std::string& interface, bool there);

/// Waits for so many frames Sync on can0.
void await_syncs(int count);

/// Tells the wire, see wire/canhil_wire.c: "can1 broken".
void wire(const std::string& what);

/// Runs a shell command that must succeed; may be called while another thread is in shell().
void run(const std::string& command);

/// hil-target on can0 while it lives.
class Target {
 public:
  Target();
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  /// What it wrote to stderr so far.
  [[nodiscard]] std::string said() const;

 private:
  std::string pid_;
};

/// hil-bench run ARGUMENTS on can1, given up after two minutes (exit code 124).
Ended bench_run(const std::string& arguments);

/// The outcome of the checks of this kind in a report; "no such check".
std::string outcome_of(const nlohmann::json& report, const std::string& kind);

}  // namespace canhil::test
