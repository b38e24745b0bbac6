// The wind over the height: profiles of four seasons, and gusts on top of them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bench/world/stream.hpp"

namespace canhil::world::glide {

enum class Season : std::uint8_t { march, june, september, december };
inline constexpr std::array<std::string_view, 4> season_names{"march", "june", "september", "december"};

/// Mean wind at whole kilometres of height, 0 to 15: the components are joined by lines; above 15 km and
/// below 0 that of the end.
class WindProfile {
 public:
  static constexpr std::size_t levels = 16;
  /// Speed [m/s] and the direction it blows from [deg clockwise from north] at 0, 1 ... 15 km.
  WindProfile(const std::array<double, levels>& speed, const std::array<double, levels>& from_deg);
  /// Synthetic, for a jet from the west: strong in winter.
  explicit WindProfile(Season season);
  /// The same wind at all heights, NED [m/s].
  explicit WindProfile(const Vector3& wind_n);

  /// NED [m/s], where the air goes to; `height` [m].
  [[nodiscard]] Vector3 at(double height) const;

 private:
  std::array<Vector3, levels> wind_n_;
};

/// Gusts: each component of NED a first-order Gauss-Markov process, the spectrum that Dryden gives to the
/// gusts along the path (MIL-F-8785C).
struct GustModel {
  double sigma = 0;  ///< [m/s]
  double time = 3;   ///< of correlation: turbulence scale over air speed [s]
};

class Gusts {
 public:
  Gusts(const GustModel& model, Stream stream);
  /// The gust now, NED [m/s].
  [[nodiscard]] const Vector3& now() const { return now_; }
  /// Goes on by dt [s]. Takes three numbers of the stream.
  void advance(double dt);

 private:
  GustModel model_;
  Stream stream_;
  Vector3 now_;
};

}  // namespace canhil::world::glide
