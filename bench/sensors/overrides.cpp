#include "bench/sensors/overrides.hpp"

#include <utility>

namespace canhil::sensors {
namespace {

class Overridden final : public Sensor {
 public:
  Overridden(std::unique_ptr<Sensor> sensor, const Kind& kind, Overrides& overrides)
      : sensor_(std::move(sensor)), kind_(kind), overrides_(overrides) {}

  [[nodiscard]] std::int64_t due_us() const override { return sensor_->due_us(); }
  Sample measure() override {
    Sample sample = sensor_->measure();
    bool is_changed = false;
    for (const auto& [of, value] : overrides_.values) {
      const auto& [kind, place] = of;
      if (kind != &kind_) continue;
      is_changed = true;
      const std::uint32_t flag = 1U << place.index;
      if (place.role == Role::value)
        sample.values[place.index] = value;
      else if (value == 0)
        sample.invalid |= flag;
      else
        sample.invalid &= ~flag;
    }
    if (is_changed) ++overrides_.samples;
    return sample;
  }
  [[nodiscard]] bool is_guided() const override { return sensor_->is_guided(); }
  void guide(const Guidance& answer) override { sensor_->guide(answer); }

 private:
  std::unique_ptr<Sensor> sensor_;
  const Kind& kind_;
  Overrides& overrides_;
};

}  // namespace

std::unique_ptr<Sensor> with_overrides(std::unique_ptr<Sensor> sensor, const Kind& kind,
                                       Overrides& overrides) {
  return std::make_unique<Overridden>(std::move(sensor), kind, overrides);
}

}  // namespace canhil::sensors
