// A sensor with a fault: the fault changes its samples, whatever messages carry them.
#pragma once

#include <memory>

#include "bench/faults/injector.hpp"
#include "bench/sensors/kind.hpp"

namespace canhil::faults {

class FaultySensor : public sensors::Sensor {
 public:
  FaultySensor(std::unique_ptr<sensors::Sensor> sensor, const InRun& run)
      : sensor_(std::move(sensor)), tally_(run.tally) {}

  [[nodiscard]] std::int64_t due_us() const override { return sensor_->due_us(); }
  sensors::Sample measure() override {
    const std::int64_t t_us = sensor_->due_us();
    sensors::Sample sample = sensor_->measure();
    if (sample.fate == sensors::Sample::Fate::sent) change(sample, t_us);
    return sample;
  }
  [[nodiscard]] bool is_guided() const final { return sensor_->is_guided(); }
  void guide(const sensors::Guidance& answer) final { sensor_->guide(answer); }

 protected:
  /// Changes a sample that is sent at `t_us`.
  virtual void change(sensors::Sample& /*sample*/, std::int64_t /*t_us*/) {}
  sensors::Sensor& sensor() { return *sensor_; }
  [[nodiscard]] const sensors::Sensor& sensor() const { return *sensor_; }
  Tally& tally() { return tally_; }

 private:
  std::unique_ptr<sensors::Sensor> sensor_;
  Tally& tally_;
};

}  // namespace canhil::faults
