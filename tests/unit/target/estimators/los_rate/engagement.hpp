#pragma once
// A head-on engagement with constant closing speed in both planes of a rolling antenna. The engagement
// follows the model of the filter, so the statistics of the filter are known. Angles are small; the antenna
// rolls, the reference axes do not.
#include <cmath>
#include <complex>
#include <random>

#include "target/estimators/los_rate/filter.hpp"

namespace canhil::los_rate {

struct EngagementSetup {
  double range = 5000, closing_speed = 900;  // [m], [m/s]
  Plane first_rate{3e-3, -2e-3};             // LOS rate at the start [rad/s]
  Plane target{0, 0};                        // target acceleration in the last `manoeuvre_s` seconds [m/s^2]
  double manoeuvre_s = 1;
  double jerk_density = 0;  // of a randomly accelerating target [m^2/s^5]
  double roll_rate = 0;     // antenna roll rate [rad/s]
  double guidance = 4;      // navigation constant; 0: the missile flies straight
  bool noisy = false;
  Settings settings;
  unsigned seed = 1;
};

/// Truth in the antenna's axes at the end of a step.
struct Truth {
  double time_to_go = 0, range = 0;
  Plane error, rate, target;
};

class Engagement {
 public:
  explicit Engagement(const EngagementSetup& setup)
      : setup_(setup), engine_(setup.seed), range_(setup.range) {
    speed_ = setup.first_rate * setup.range;  // y' = r w - vc lambda, lambda = 0
  }
  [[nodiscard]] bool over() const { return range_ - setup_.closing_speed * Ts() < 1; }
  [[nodiscard]] const Truth& truth() const { return truth_; }

  Measurement next() {
    const double T = Ts(), vc = setup_.closing_speed;
    const Plane before_error = displacement_ / range_ - antenna_;
    // The missile acceleration is the mean over the step. The target acceleration is the sum of two parts,
    // one from white jerk and one from the manoeuvre.
    const double to_go = range_ / vc;
    const Plane rate = (speed_ + vc * displacement_ / range_) / range_;
    Plane missile = setup_.guidance * vc * rate;
    if (std::abs(missile) > 350) missile *= 350 / std::abs(missile);
    const Plane jerk = std::sqrt(setup_.jerk_density / T) * Plane{normal(), normal()};
    const Plane target = to_go < setup_.manoeuvre_s ? setup_.target : Plane{};
    const Plane a = wander_ + target - missile;
    displacement_ += speed_ * T + a * (T * T / 2) + jerk * (T * T * T / 6);
    speed_ += a * T + jerk * (T * T / 2);
    wander_ += jerk * T;
    range_ -= vc * T;
    const Plane turn = before_error * (1 - std::exp(-12 * T));  // antenna servo with a bandwidth of 12 rad/s
    antenna_ += turn;

    const double half = setup_.roll_rate * T / 2;
    const Plane middle = std::polar(1.0, roll_ + half);
    roll_ += 2 * half;
    const Plane end = std::polar(1.0, roll_);
    const Plane lambda = displacement_ / range_;
    truth_ = {range_ / vc, range_, (lambda - antenna_) * end, (speed_ + vc * lambda) / range_ * end,
              (wander_ + target) * end};

    Plane measured = truth_.error;
    if (setup_.noisy) {
      const Planes<Noise>& noise = setup_.settings.noise;
      measured += Plane{std::sqrt(sample_variance(noise.yaw, range_)) * normal(),
                        std::sqrt(sample_variance(noise.pitch, range_)) * normal()};
    }
    const Plane increment = turn * middle, acceleration = missile * middle;
    return {.dt = T,
            .error = {measured.imag(), measured.real()},
            .antenna_increment = {increment.imag(), increment.real()},
            .roll_increment = 2 * half,
            .missile_acceleration = {-acceleration.imag(), acceleration.real()},
            .range = {range_, vc, true, true},
            .error_valid = true,
            .antenna_valid = true,
            .acceleration_valid = true};
  }

 private:
  double Ts() const { return setup_.settings.sample_period; }
  double normal() { return normal_(engine_); }

  EngagementSetup setup_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  double range_, roll_ = 0;
  Plane displacement_, speed_, wander_, antenna_;
  Truth truth_;
};

/// Runs an engagement, handing truth, state and result of each step to `inspect`.
template <class Inspect>
State run(const EngagementSetup& setup, Inspect inspect) {
  const Design design = make_design(setup.settings);
  Engagement engagement(setup);
  State state = initial();
  while (!engagement.over()) {
    const Measurement m = engagement.next();
    const UpdateResult result = step(state, m, design);
    inspect(engagement.truth(), state, result);
  }
  return state;
}

inline EngagementSetup setup_of(Algorithm algorithm) {
  EngagementSetup setup;
  setup.settings.algorithm = algorithm;
  return setup;
}

}  // namespace canhil::los_rate
