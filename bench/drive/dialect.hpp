// The dialect in which a session and its target communicate: either the messages of canhil's own DBC, with
// handshake and time base, or the target's own messages, to which a mapping assigns quantities.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/drive/buses.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/observe/target_watch.hpp"
#include "bench/observe/watcher.hpp"
#include "dbc/ports/fd_groups.hpp"

namespace canhil::drive {

/// How long the bench looks for a target on the bus: the target may still be starting.
constexpr std::int64_t find_limit_ns = 5'000'000'000;

/// The properties of a run that are known before the run begins.
struct Setting {
  const scenario::Scenario& scenario;
  const world::FlightRecord& truth;
  Flight& flight;
  std::uint64_t run_index = 0;
  bool in_process = false;    ///< the target is the device in this process
  bool virtual_time = false;  ///< time advances in steps; the target completes each step
  Rounding rounding = Rounding::as_on_the_bus;
  BusFormat format = BusFormat::classic;
  WireFacts wire{};
  bool of_log = false;       ///< a log says what the target answers: nobody talks to it
  std::size_t programs = 0;  ///< number of targets that the bench starts
  Others others{};           ///< the programs on the bus
};

class Dialect {
 public:
  Dialect() = default;
  Dialect(const Dialect&) = delete;
  Dialect& operator=(const Dialect&) = delete;
  virtual ~Dialect() = default;

  /// `faults`: the faults of the run.
  virtual std::unique_ptr<Schedule> schedule(std::unique_ptr<faults::Faults> faults) = 0;
  virtual std::unique_ptr<observe::Watcher> watcher(bool with_times) = 0;
  /// Whether watchers depend on frames only. If so, they may run in other threads.
  [[nodiscard]] virtual bool watches_frames_alone() const = 0;
  /// `alone`: no other node can be on the bus.
  virtual std::unique_ptr<observe::TargetWatch> target_watch(bool alone) = 0;
  /// Configures the target. `gone`: if waiting for the target is pointless, returns the reason. Error: one
  /// line.
  virtual Result<void> configure(Link& link, nodes::Transmission& out,
                                 const std::function<std::optional<std::string>()>& gone) = 0;
  /// Stops the target after the run.
  virtual void stop(Link& link, nodes::Transmission& out) = 0;
  /// What follows the requests of events and their answers in a log; null: nothing.
  virtual observe::Observer* dialogue() { return nullptr; }
  /// The requests so far and their answers.
  [[nodiscard]] virtual std::vector<checks::Exchange> exchanges() const { return {}; }
  /// In real time, a target that is silent for longer than this time counts as gone.
  [[nodiscard]] virtual std::int64_t silence_limit_ns() const = 0;
};

/// The dialect of the scenario. Everything that the setting refers to must outlive the dialect. Error, one
/// line: the scenario does not fit its mapping.
Result<std::unique_ptr<Dialect>> make_dialect(const Setting& setting);
std::unique_ptr<Dialect> contract_dialect(const Setting& setting);
Result<std::unique_ptr<Dialect>> mapped_dialect(const Setting& setting);

}  // namespace canhil::drive
