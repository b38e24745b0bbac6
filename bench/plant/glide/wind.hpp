// The wind as a function of height: profiles of four seasons, plus gusts.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bench/world/stream.hpp"

namespace canhil::plant::glide {

using world::Stream;
using world::Vector3;

enum class Season : std::uint8_t { march, june, september, december };
inline constexpr std::array<std::string_view, 4> season_names{"march", "june", "september", "december"};

/// The mean wind at whole kilometres of height, from 0 to 15 km. Between them, each component is interpolated
/// linearly. Below 0 and above 15 km, the value at the nearest end is used.
class WindProfile {
 public:
  static constexpr std::size_t levels = 16;
  /// `speed`: the speed of the wind [m/s] at the heights 0, 1 ... 15 km. `from_deg`: the direction from which
  /// the wind blows at these heights [deg clockwise from north].
  WindProfile(const std::array<double, levels>& speed, const std::array<double, levels>& from_deg);
  /// A synthetic profile with a jet stream from the west, which is strong in winter.
  explicit WindProfile(Season season);
  /// The same wind at all heights, NED [m/s].
  explicit WindProfile(const Vector3& wind_n);

  /// Velocity of the air at a height [m], NED [m/s].
  [[nodiscard]] Vector3 at(double height) const;

 private:
  std::array<Vector3, levels> wind_n_;
};

/// Gusts: each component in NED is a first-order Gauss-Markov process, which has the Dryden spectrum of gusts
/// along the path (MIL-F-8785C).
struct GustModel {
  double sigma = 0;  ///< [m/s]
  double time = 3;   ///< correlation time: turbulence scale over air speed [s]
};

class Gusts {
 public:
  Gusts(const GustModel& model, Stream stream);
  /// The current gust, NED [m/s].
  [[nodiscard]] const Vector3& now() const { return now_; }
  /// Advances by dt [s]. Takes three numbers from the stream.
  void advance(double dt);

 private:
  GustModel model_;
  Stream stream_;
  Vector3 now_;
};

}  // namespace canhil::plant::glide
