#include "bench/world/motion/sea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int wave_count = 40;

/// The frequencies [rad/s] that divide the spectrum's energy: the one with the fraction `x` below it.
class EnergyDivision {
 public:
  explicit EnergyDivision(const SeaModel& model) {
    // 0.2 % of the energy is above five times the peak's frequency, and none to speak of below 0.4 of it.
    const double peak = two_pi / model.peak_period, lowest = 0.4 * peak, highest = 5 * peak;
    constexpr int steps = 4000;
    for (int step = 0; step <= steps; ++step) {
      omega_.push_back(lowest + (highest - lowest) * step / steps);
      const double middle = omega_.back() - 0.5 * (highest - lowest) / steps;
      below_.push_back(step == 0 ? 0 : below_.back() + wave_spectrum(model, middle));
    }
  }
  [[nodiscard]] double frequency(double x) const {
    const double energy = x * below_.back();
    const auto after = std::upper_bound(below_.begin() + 1, below_.end() - 1, energy);
    const auto i = static_cast<std::size_t>(after - below_.begin());
    const double within = (energy - below_[i - 1]) / (below_[i] - below_[i - 1]);
    return omega_[i - 1] + within * (omega_[i] - omega_[i - 1]);
  }

 private:
  std::vector<double> omega_, below_;
};

/// The response of a damped oscillator to sin(omega t), at r times its natural frequency, as multiples of
/// sin(omega t) and cos(omega t).
struct Response {
  double sine;
  double cosine;
};
Response response(double r, double damping) {
  const double real = 1 - r * r, imaginary = 2 * damping * r;
  const double square = real * real + imaginary * imaginary;
  return {.sine = real / square, .cosine = -imaginary / square};
}

}  // namespace

double wave_spectrum(const SeaModel& model, double omega) {
  const double x = omega * model.peak_period / two_pi;
  const double width = x <= 1 ? 0.07 : 0.09;
  const double near_peak = std::exp(-0.5 * std::pow((x - 1) / width, 2));
  return std::pow(x, -5) * std::exp(-1.25 * std::pow(x, -4)) * std::pow(model.peakedness, near_peak);
}

Sea::Sea(const SeaModel& model, Stream& stream) : towards_(model.from + std::numbers::pi) {
  const EnergyDivision division(model);
  const double amplitude = model.significant_height / 4 * std::sqrt(2.0 / wave_count);
  for (int line = 0; line < wave_count; ++line) {
    const double omega = division.frequency((line + stream.uniform()) / wave_count);
    const double phase = two_pi * stream.uniform();
    const double wave_number = omega * omega / units::standard_gravity;
    const double length_ratio = model.length * wave_number / two_pi;
    const Response roll = response(omega * model.roll_period / two_pi, model.roll_damping);
    const Response pitch = response(omega * model.pitch_period / two_pi, model.pitch_damping);
    const double slope = amplitude * wave_number;
    waves_.push_back({.omega = omega,
                      .phase = phase,
                      .displacement = amplitude / (1 + length_ratio * length_ratio),
                      .roll_sine = slope * roll.sine,
                      .roll_cosine = slope * roll.cosine,
                      .pitch_sine = slope * pitch.sine,
                      .pitch_cosine = slope * pitch.cosine});
  }
}

Vector3 Sea::in_ned(double along, double up) const {
  return {std::cos(towards_) * along, std::sin(towards_) * along, -up};
}

// The elevation is a cos(omega t - k x + phase), x along the direction of travel. So the slope is k a
// sin(...), and the water at the surface moves by a sin(...) along x.
void Sea::add_to(Kinematics& kinematics, double t) const {
  double up = 0, up_rate = 0, along = 0, along_rate = 0;  // velocities and accelerations
  double roll = 0, roll_rate = 0, pitch = 0, pitch_rate = 0;
  for (const Wave& wave : waves_) {
    const double w = wave.omega, angle = w * t + wave.phase;
    const double s = std::sin(angle), c = std::cos(angle);
    up -= wave.displacement * w * s;
    up_rate -= wave.displacement * w * w * c;
    along += wave.displacement * w * c;
    along_rate -= wave.displacement * w * w * s;
    roll += wave.roll_sine * s + wave.roll_cosine * c;
    roll_rate += w * (wave.roll_sine * c - wave.roll_cosine * s);
    pitch += wave.pitch_sine * s + wave.pitch_cosine * c;
    pitch_rate += w * (wave.pitch_sine * c - wave.pitch_cosine * s);
  }
  kinematics.v_eb_n += in_ned(along, up);
  kinematics.v_eb_n_rate += in_ned(along_rate, up_rate);
  // Water that rises ahead lifts the bow; water that rises to starboard rolls the vessel to port.
  const double ahead = std::cos(towards_ - kinematics.angles.heading);
  const double abeam = std::sin(towards_ - kinematics.angles.heading);
  const double turning = kinematics.rates.heading;
  kinematics.angles.roll -= roll * abeam;
  kinematics.rates.roll -= roll_rate * abeam - roll * ahead * turning;
  kinematics.angles.pitch += pitch * ahead;
  kinematics.rates.pitch += pitch_rate * ahead + pitch * abeam * turning;
}

Vector3 Sea::velocity(double t) const {
  double up = 0, along = 0;
  for (const Wave& wave : waves_) {
    const double angle = wave.omega * t + wave.phase, speed = wave.displacement * wave.omega;
    up -= speed * std::sin(angle);
    along += speed * std::cos(angle);
  }
  return in_ned(along, up);
}

Vector3 Sea::displacement(double t) const {
  double up = 0, along = 0;
  for (const Wave& wave : waves_) {
    up += wave.displacement * std::cos(wave.omega * t + wave.phase);
    along += wave.displacement * std::sin(wave.omega * t + wave.phase);
  }
  return in_ned(along, up);
}

double Sea::highest() const { return std::ranges::max(waves_, {}, &Wave::omega).omega; }

}  // namespace canhil::world
