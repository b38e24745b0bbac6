// The engagement as a plant: its outputs are what a seeker sees, and the miss.
#pragma once

#include <array>
#include <memory>

#include "bench/plant/engagement/engagement.hpp"
#include "bench/plant/plant.hpp"

namespace canhil::plant::engagement {

/// Steered by Plant::guide() with the LOS rate in axes n [rad/s] and the closing speed [m/s]. It ends at the
/// closest approach; `relative` is then the miss. An increment is the one of the last step.
class Missile final : public Plant {
 public:
  Missile(const Settings& settings, Stream stream);

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override;
  bool guide(std::int64_t from_us, std::span<const double> inputs) override;
  [[nodiscard]] std::optional<std::int64_t> ended_us() const override;

 private:
  void show();

  Engagement engagement_;
  std::array<double, 23> outputs_{};
};

class MissilePlan final : public Plan {
 public:
  explicit MissilePlan(const Settings& settings);
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& draw) const override;

  [[nodiscard]] const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
};

}  // namespace canhil::plant::engagement
