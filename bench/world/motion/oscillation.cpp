#include "bench/world/motion/oscillation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bench/world/motion/oscillating.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Three phases, uniform. Draws three numbers.
Vector3 phases(Stream& stream) {
  Vector3 all;
  for (double& phase : all) phase = full_turn * stream.uniform();
  return all;
}

/// The rate of a rotation exp([theta x]) in the rotated axes, from theta and its derivative.
Vector3 rate_of_rotation(const Vector3& theta, const Vector3& theta_rate) {
  const double square = theta.squaredNorm(), angle = std::sqrt(square);
  // (1 - cos x) / x^2 and (x - sin x) / x^3; for small x by their series.
  const bool small = angle < 1e-2;
  const double first = small ? 0.5 - square / 24 + square * square / 720 : (1 - std::cos(angle)) / square;
  const double second =
      small ? 1.0 / 6 - square / 120 + square * square / 5040 : (angle - std::sin(angle)) / (square * angle);
  const Vector3 cross = theta.cross(theta_rate);
  return theta_rate - first * cross + second * theta.cross(cross);
}

}  // namespace

Oscillation::Oscillation(BuiltInMotion base, const OscillationModel& model, std::uint64_t seed)
    : base_(std::move(base)) {
  Stream stream(seed, 0, "truth.vibration");
  for (const Sinusoid& one : model.sinusoids) {
    const Vector3 random = phases(stream);
    add(one.frequency, one.acceleration, one.angle, one.phase.value_or(random));
  }
  for (const RandomVibration& one : model.random) {
    const double band = (one.to - one.from) / static_cast<double>(one.lines);
    const Vector3 amplitude = (2 * band * one.psd).cwiseSqrt();
    for (std::int64_t line = 0; line < one.lines; ++line) {
      const double frequency = one.from + band * (static_cast<double>(line) + stream.uniform());
      add(frequency, amplitude, Vector3::Zero(), phases(stream));
    }
  }
  double highest = 0;  // [rad/s]
  for (const Line& line : lines_) highest = std::max(highest, line.omega);
  if (model.sea) {
    Stream waves(seed, 0, "truth.sea");
    sea_.emplace(*model.sea, waves);
    highest = std::max(highest, sea_->highest());
  }
  if (highest > 0)
    piece_us_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(1e6 * full_turn / highest / 8));
}

// The acceleration is a sin(omega t + phase), so the velocity is -a / omega cos(omega t + phase).
void Oscillation::add(double frequency, const Vector3& acceleration, const Vector3& angle,
                      const Vector3& phase) {
  const double omega = full_turn * frequency;
  const Vector3 sine = phase.array().sin(), cosine = phase.array().cos();
  lines_.push_back({.omega = omega,
                    .sine = acceleration.cwiseProduct(sine) / omega,
                    .cosine = -acceleration.cwiseProduct(cosine) / omega,
                    .angle_sine = angle.cwiseProduct(cosine),
                    .angle_cosine = angle.cwiseProduct(sine)});
}

Kinematics Oscillation::kinematics(double t) const {
  Kinematics now = std::visit([t](const auto& own) { return world::kinematics(own, t); }, base_);
  if (sea_) sea_->add_to(now, t);
  return now;
}

Movement Oscillation::movement(double t) const {
  const Kinematics below = kinematics(t);
  Movement now{.v_eb_n = below.v_eb_n,
               .v_eb_n_rate = below.v_eb_n_rate,
               .C_bn = C_bn_from(below.angles),
               .omega_nb_b = omega_nb_b(below.angles, below.rates)};
  if (lines_.empty()) return now;
  Vector3 u = Vector3::Zero(), u_rate = Vector3::Zero();
  Vector3 theta = Vector3::Zero(), theta_rate = Vector3::Zero();
  for (const Line& line : lines_) {
    const double s = std::sin(line.omega * t), c = std::cos(line.omega * t);
    u += s * line.sine + c * line.cosine;
    u_rate += line.omega * (c * line.sine - s * line.cosine);
    theta += s * line.angle_sine + c * line.angle_cosine;
    theta_rate += line.omega * (c * line.angle_sine - s * line.angle_cosine);
  }
  now.v_eb_n += now.C_bn * u;
  now.v_eb_n_rate += now.C_bn * (now.omega_nb_b.cross(u) + u_rate);
  const Matrix3 turned = rotation(theta);
  now.C_bn = now.C_bn * turned;
  now.omega_nb_b = turned.transpose() * now.omega_nb_b + rate_of_rotation(theta, theta_rate);
  return now;
}

Vector3 Oscillation::velocity(double t) const {
  if (lines_.empty()) {
    const Vector3 base = std::visit([t](const auto& own) { return world::kinematics(own, t).v_eb_n; }, base_);
    return sea_ ? Vector3(base + sea_->velocity(t)) : base;
  }
  const Kinematics below = kinematics(t);
  Vector3 u = Vector3::Zero();
  for (const Line& line : lines_)
    u += std::sin(line.omega * t) * line.sine + std::cos(line.omega * t) * line.cosine;
  return below.v_eb_n + C_bn_from(below.angles) * u;
}

Vector3 Oscillation::displacement(double t) const { return sea_ ? sea_->displacement(t) : Vector3::Zero(); }

std::vector<std::int64_t> Oscillation::jumps_us(std::int64_t from_us, std::int64_t to_us) const {
  const Motion base = std::visit([](const auto& own) -> Motion { return own; }, base_);
  std::vector<std::int64_t> jumps = world::jumps_us(base, from_us, to_us);
  if (piece_us_ == 0) return jumps;
  const std::int64_t length = to_us - from_us, pieces = (length + piece_us_ - 1) / piece_us_;
  for (std::int64_t piece = 1; piece < pieces; ++piece) jumps.push_back(from_us + piece * length / pieces);
  std::ranges::sort(jumps);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return jumps;
}

Movement movement(const Oscillating& motion, double t) { return motion.motion->movement(t); }
Vector3 velocity(const Oscillating& motion, double t) { return motion.motion->velocity(t); }

Flight drawn(const Flight& flight, std::uint64_t seed) {
  if (!flight.oscillations) return flight;
  auto motion = std::visit(
      [&](const auto& own) -> std::shared_ptr<const Oscillation> {
        if constexpr (std::is_constructible_v<BuiltInMotion, decltype(own)>)
          return std::make_shared<const Oscillation>(own, *flight.oscillations, seed);
        assert(false);
        return nullptr;
      },
      flight.motion);
  const Position start = displaced(flight.start, motion->displacement(0));
  return {.start = start, .motion = Oscillating{std::move(motion)}};
}

}  // namespace canhil::world
