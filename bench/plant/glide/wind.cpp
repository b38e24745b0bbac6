#include "bench/plant/glide/wind.hpp"

#include <algorithm>
#include <cmath>

#include "bench/world/gauss_markov.hpp"
#include "bench/world/units.hpp"

namespace canhil::plant::glide {
namespace {

namespace units = world::units;

struct Table {
  std::array<double, WindProfile::levels> speed;
  std::array<double, WindProfile::levels> from_deg;
};

// clang-format off
constexpr Table march{{3, 8, 12, 17, 22, 28, 34, 40, 47, 53, 58, 62, 60, 52, 44, 36},
                      {300, 290, 282, 277, 273, 271, 269, 267, 266, 265, 264, 264, 265, 266, 268, 270}};
constexpr Table june{{2, 4, 6, 8, 9, 11, 13, 15, 17, 19, 21, 22, 21, 18, 14, 10},
                     {200, 215, 230, 242, 250, 256, 260, 263, 266, 268, 270, 271, 272, 274, 276, 280}};
constexpr Table september{{2, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 19, 18, 15, 12, 9},
                          {60, 350, 310, 290, 282, 277, 273, 271, 270, 269, 268, 267, 267, 268, 270, 272}};
constexpr Table december{{4, 9, 14, 20, 27, 34, 41, 48, 55, 61, 66, 70, 68, 60, 50, 42},
                         {320, 305, 295, 288, 283, 279, 276, 273, 271, 270, 269, 268, 268, 269, 270, 271}};
// clang-format on

constexpr const Table& table_of(Season season) {
  switch (season) {
    case Season::march:
      return march;
    case Season::june:
      return june;
    case Season::september:
      return september;
    case Season::december:
      break;
  }
  return december;
}

}  // namespace

WindProfile::WindProfile(const std::array<double, levels>& speed,
                         const std::array<double, levels>& from_deg) {
  for (std::size_t i = 0; i < levels; ++i) {
    const double from = from_deg[i] * units::deg;
    wind_n_[i] = -speed[i] * Vector3(std::cos(from), std::sin(from), 0);
  }
}

WindProfile::WindProfile(Season season) : WindProfile(table_of(season).speed, table_of(season).from_deg) {}

WindProfile::WindProfile(const Vector3& wind_n) { wind_n_.fill(wind_n); }

Vector3 WindProfile::at(double height) const {
  const double level = std::clamp(height / 1000, 0.0, static_cast<double>(levels - 1));
  const std::size_t below = std::min(static_cast<std::size_t>(level), levels - 2);
  const double share = level - static_cast<double>(below);
  return (1 - share) * wind_n_[below] + share * wind_n_[below + 1];
}

Gusts::Gusts(const GustModel& model, Stream stream)
    : model_(model), stream_(stream), now_(model.sigma * stream_.normal3()) {}

void Gusts::advance(double dt) {
  now_ = world::GaussMarkov(dt / model_.time, model_.sigma).next(now_, stream_.normal3());
}

}  // namespace canhil::plant::glide
