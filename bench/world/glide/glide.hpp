// The truth of an unpowered glider in the wind: six degrees of freedom over a flat, non-rotating Earth. The
// published estimator uses the same model of the Earth.
//
// States: position and ground velocity (NED), attitude quaternion, rates, fins, and the autopilot's integral.
// The air velocity is not a state, so the equations differ from those of any wind filter. The wind acts on
// the glider only through its air velocity: v_a = C_nb (v_eb_n - wind(height) - gust). The equations are
// integrated by a fourth-order Runge-Kutta method.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/world/glide/aerodynamics.hpp"
#include "bench/world/glide/coefficient_errors.hpp"
#include "bench/world/glide/wind.hpp"

namespace canhil::world {

/// The parameters of a glide. The glider starts level on its heading, at `speed` through the air, with fins
/// at zero.
struct GlidePlan {
  double heading = 0;      ///< [rad]
  double speed = 250;      ///< [m/s]
  double height = 10'000;  ///< [m]
  glide::WindProfile wind{glide::Season::march};
  glide::GustModel gusts;
  glide::CoefficientErrorModel coefficients;
  double density_error = 0;  ///< true density over the standard density, minus 1
};

/// The true state at one instant.
struct GlideTruth {
  std::int64_t t_us = 0;
  Vector3 position_n = Vector3::Zero();  ///< from the start, NED [m]
  double height = 0;                     ///< [m]
  Vector3 v_eb_n = Vector3::Zero();      ///< [m/s]
  Matrix3 C_bn = Matrix3::Identity();
  Vector3 omega_nb_b = Vector3::Zero();  ///< [rad/s]
  glide::Fins fins = glide::Fins::Zero();
  Vector3 wind_n = Vector3::Zero();  ///< velocity of the air, gusts included, NED [m/s]
  Vector3 v_a = Vector3::Zero();     ///< velocity through the air, body [m/s]
};

/// A complete glide.
class GlideRecord {
 public:
  static constexpr std::int64_t step_us = 10'000;

  /// Flies from 0 to the last step at or before duration_us, or until the glider reaches the ground or its
  /// speed over ground reaches 1000 m/s. The streams are used for coefficients and gusts.
  GlideRecord(const GlidePlan& plan, std::int64_t duration_us, Stream coefficients, Stream gusts);

  /// Truth every 10 ms from 0 on.
  [[nodiscard]] std::span<const GlideTruth> epochs() const { return epochs_; }
  [[nodiscard]] std::int64_t end_us() const { return epochs_.back().t_us; }
  /// The truth at a multiple of 10 ms in [0, end_us()].
  [[nodiscard]] const GlideTruth& at(std::int64_t t_us) const {
    return epochs_[static_cast<std::size_t>(t_us / step_us)];
  }

 private:
  std::vector<GlideTruth> epochs_;
};

}  // namespace canhil::world
