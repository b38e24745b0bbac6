// What moves: a plant has a state, which commands steer and outputs show. It knows no bus, no sensor and no
// target. A kind of plant is a folder or a file here and a line in registry.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/processes/variable.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::plant {

using processes::Variable;

/// A plant in a run. It is deterministic: its outputs depend on Draw, the steps and the inputs alone.
class Plant {
 public:
  Plant() = default;
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;
  virtual ~Plant() = default;

  /// The values of Plan::outputs at the time that the plant has reached.
  [[nodiscard]] virtual std::span<const double> outputs() const = 0;
  /// Advances the plant from one time [us] of the run to another, while Plan::inputs have these values.
  /// Error, one phrase with the name of the plant and the reason: it cannot advance, and is not asked again.
  virtual Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) = 0;

  /// Takes values of Plan::inputs that act from a time [us] on which may lie inside a step; in order of time.
  /// Returns false if the plant has passed this time: then they act at once.
  virtual bool guide(std::int64_t /*from_us*/, std::span<const double> /*inputs*/) { return true; }
  /// When its motion came to an end of its own, such as the closest approach of two bodies: it is not asked
  /// to advance again, and its outputs are those of this time. None: it has no such end, or not yet.
  [[nodiscard]] virtual std::optional<std::int64_t> ended_us() const { return std::nullopt; }
};

/// What is drawn at random, and how the plant is run.
struct Draw {
  std::uint64_t seed = 0;
  std::uint64_t run_index = 0;
  std::int64_t sensors_us = 0;  ///< for Plan::steps_with_sensors; 0: no sensor measures the plant
};

/// A plant as a scenario describes it; its runs share it, also in several threads.
class Plan {
 public:
  Plan() = default;
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  virtual ~Plan() = default;

  /// A plant at time 0. Error, one phrase: it cannot be made.
  [[nodiscard]] virtual Result<std::unique_ptr<Plant>> make(const Draw& draw) const = 0;

  std::vector<Variable> inputs{}, outputs{};
  /// Its step, unless the scenario says another; commands act from the start of a step on.
  std::int64_t step_us = 10'000;
  /// Nothing steers it, and it advances to the end before the run: an end of its own is then an error before
  /// the run.
  bool flown_ahead = false;
  /// Its step is the period of its sensors, or what their periods are multiples of.
  bool steps_with_sensors = false;
  /// It never advances beyond the present, because commands act inside a step (Plant::guide()).
  bool never_ahead = false;
};

struct Kind {
  std::string_view key;      ///< of `kind` in the table [plant]
  std::string_view meaning;  ///< one sentence for the reference
  /// Reads the keys of the table [plant] that belong to the kind. Errors are reported to the section.
  std::unique_ptr<Plan> (*read)(scenario::Section& section) = nullptr;
};

}  // namespace canhil::plant
