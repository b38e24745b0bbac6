// Helper functions for tests in the guest system that tests/controller/run.sh starts. The target uses the
// interface can0; the bench uses can1.
#pragma once

#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {

/// Sets both interfaces down, and then up with these options, as `ip link set can0 up type can OPTIONS` does.
void set_up(const std::string& can0_options, const std::string& can1_options);

/// Loads the kernel module of the wire if it is not loaded yet, and sets up both interfaces at 1 Mbit/s. The
/// arguments are additional options of can0 and of can1.
void set_up_on_wire(const std::string& can0_options = "", const std::string& can1_options = "");

/// Sets the interface up or down, as `ip link set` does. Does not wait until the interface has a carrier.
void set_interface(const std::string& interface, bool up);

/// Waits until the interface has a carrier if `there` is true, or until it has none if `there` is false.
/// Waits for at most half a minute. The interface of a bus-off controller has no carrier.
void await_carrier(const std::string& interface, bool there);

/// Waits for `count` Sync frames on can0.
void await_syncs(int count);

/// Configures the wire with a command of wire/canhil_wire.c, such as "can1 broken".
void wire(const std::string& what);

/// Runs a shell command that must succeed. May be called while another thread executes shell().
void run(const std::string& command);

/// Runs hil-target on can0 during the lifetime of the object.
class Target {
 public:
  Target();
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  /// What the target has printed on stderr so far.
  [[nodiscard]] std::string said() const;

 private:
  std::string pid_;
};

/// Runs `hil-bench run ARGUMENTS` on can1. If the program has not ended after two minutes, it is stopped, and
/// the exit code is 124.
Ended bench_run(const std::string& arguments);

/// The outcome of the first check of this kind in a report, or "no such check".
std::string outcome_of(const nlohmann::json& report, const std::string& kind);

}  // namespace canhil::test
