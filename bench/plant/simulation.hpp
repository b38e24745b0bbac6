// A plant in a run: takes commands, advances, records its outputs, and moves the carrier.
//
// The plant advances by whole steps. A command acts from the start of the first step on that begins at or
// after its arrival plus its delay, and is held. So the flight depends on the arrival of the commands alone,
// and not on when somebody looks at it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/plant/setup.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::plant {

class Simulation {
 public:
  /// `carrier`: the start of a carrier that the plant moves, with the duration of the run and the interval of
  /// the IMU's samples. Everything must outlive the simulation. Error, one line: the plant cannot be made.
  struct Carrier {
    world::Position start;
    std::int64_t duration_us = 0, interval_us = 0;
  };
  static Result<std::unique_ptr<Simulation>> begin(const Setup& setup, const Draw& draw,
                                                   const Carrier& carrier);

  /// A command arrives; in order of time. `command`: index in Setup::commands. A value that is not finite
  /// counts as no command.
  void give(std::size_t command, const world::Given& given);
  /// A message that carries a command is none for which lockstep waits (world::CommandRecord::unawaited).
  void note_unawaited(std::size_t command, std::string message) {
    record_.commands[command].unawaited = std::move(message);
  }
  /// Commands values of Plan::inputs that act from a time [us] on; in order of time (Plant::guide()).
  void guide(std::int64_t from_us, std::span<const double> inputs);
  /// Advances so far that everything is known up to a time [us] of the run, or up to the last step before it
  /// (Plan::never_ahead). After a failure or an end of its own, nothing moves any more.
  void advance(std::int64_t t_us);

  [[nodiscard]] const world::PlantRecord& record() const { return record_; }
  [[nodiscard]] bool flown_ahead() const { return setup_.plan->flown_ahead; }
  /// The flight of the carrier; null: the plant does not move it.
  [[nodiscard]] const world::FlightRecord* flight() const { return flight_ ? &*flight_ : nullptr; }
  /// Why the plant does not advance; none: it does.
  [[nodiscard]] const std::optional<std::string>& why_failed() const { return failure_; }

 private:
  Simulation(const Setup& setup, std::unique_ptr<Plant> plant, std::int64_t step_us, const Carrier& carrier);
  [[nodiscard]] std::vector<double> inputs_at(std::int64_t t_us);
  bool observe();
  void move();
  [[nodiscard]] world::GrownPath::Point point() const;

  const Setup& setup_;
  std::unique_ptr<Plant> plant_;
  std::int64_t step_us_, t_us_ = 0, end_us_ = 0;
  world::PlantRecord record_;
  std::vector<std::size_t>
      next_;  // for each command: the first of world::CommandRecord::given that does not act yet
  std::shared_ptr<world::GrownPath> path_;
  std::optional<world::FlightRecord> flight_;
  std::optional<std::string> failure_;
};

/// Why one of these plants does not advance; none: each does.
[[nodiscard]] std::optional<std::string> why_failed(std::span<Simulation* const> plants);

}  // namespace canhil::plant
