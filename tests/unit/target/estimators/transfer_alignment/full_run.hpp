#pragma once
// The inputs of the published full run: 2000 IMU samples and 200 master velocities of one noisy flight.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "target/estimators/strapdown/imu_increment.hpp"
#include "tests/unit/target/estimators/csv.hpp"

namespace canhil::transfer_alignment {

struct Sample {
  strapdown::ImuIncrement imu;
  std::optional<Eigen::Vector3d> master_velocity;  // valid at the end of the increment
};

inline std::vector<Sample> full_run_inputs() {
  const Csv csv(std::string(TEST_DATA_DIR) + "/transfer_alignment/full_run_inputs.csv");
  using Row = Eigen::Map<const Eigen::Vector3d>;
  std::vector<Sample> samples;
  samples.reserve(csv.rows());
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double dt = csv.at(row, "dt");
    Sample sample{{Row(csv.from(row, "wx")) * dt, Row(csv.from(row, "fx")) * dt, dt}, std::nullopt};
    if (csv.at(row, "upd") != 0) sample.master_velocity = Row(csv.from(row, "Vm_N"));
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace canhil::transfer_alignment
