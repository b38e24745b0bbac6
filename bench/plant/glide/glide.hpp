// A plant: an unpowered glider in the wind, with six degrees of freedom over a flat, non-rotating Earth. The
// published estimator uses the same model of the Earth. Nothing steers it but its own autopilot.
//
// States: position and ground velocity (NED), attitude quaternion, rates, fins, and the autopilot's integral.
// The air velocity is not a state, so the equations differ from those of any wind filter. The wind acts on
// the glider only through its air velocity: v_a = C_nb (v_eb_n - wind(height) - gust). The equations are
// integrated by a fourth-order Runge-Kutta method.
#pragma once

#include <array>
#include <cstdint>

#include "bench/plant/glide/aerodynamics.hpp"
#include "bench/plant/glide/coefficient_errors.hpp"
#include "bench/plant/glide/wind.hpp"
#include "bench/plant/plant.hpp"

namespace canhil::plant::glide {

/// The parameters of a glide. The glider starts level on its heading, at `speed` through the air, with fins
/// at zero.
struct Settings {
  double heading = 0;      ///< [rad]
  double speed = 250;      ///< [m/s]
  double height = 10'000;  ///< [m]
  WindProfile wind{Season::march};
  GustModel gusts;
  CoefficientErrorModel coefficients;
  double density_error = 0;  ///< true density over the standard density, minus 1
};

/// The true state at one instant.
struct Truth {
  std::int64_t t_us = 0;
  Vector3 position_n = Vector3::Zero();  ///< from the start, NED [m]
  double height = 0;                     ///< [m]
  Vector3 v_eb_n = Vector3::Zero();      ///< [m/s]
  Matrix3 C_bn = Matrix3::Identity();
  Vector3 omega_nb_b = Vector3::Zero();  ///< [rad/s]
  Fins fins = Fins::Zero();
  Vector3 wind_n = Vector3::Zero();  ///< velocity of the air, gusts included, NED [m/s]
  Vector3 v_a = Vector3::Zero();     ///< velocity through the air, body [m/s]
};

class Glider final : public Plant {
 public:
  static constexpr std::int64_t step_us = 10'000;

  /// The streams are used for coefficients and gusts.
  Glider(const Settings& settings, Stream coefficients, Stream gusts);

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  /// Fails when the glider reaches the ground, or its speed over ground reaches 1000 m/s.
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override;

  [[nodiscard]] const Truth& now() const { return now_; }

 private:
  // The elements of the state: position, v_eb_n, quaternion (w, x, y, z), omega, fins, integral of pitch.
  using State = Eigen::Matrix<double, 17, 1>;
  struct Gust;

  [[nodiscard]] State derivative(const State& x, double share, const Gust& gust) const;
  [[nodiscard]] State advanced(double dt, const Gust& gust) const;
  [[nodiscard]] double height_of(const State& x) const;
  [[nodiscard]] bool flies(const State& x) const;
  void show(std::int64_t t_us);

  Settings settings_;
  CoefficientErrors errors_;
  Gusts gusts_;
  State x_;
  Truth now_;
  std::array<double, 22> outputs_{};
};

class GliderPlan final : public Plan {
 public:
  explicit GliderPlan(const Settings& settings);
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& draw) const override;

  [[nodiscard]] const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
};

}  // namespace canhil::plant::glide
