// The claims of the transfer-alignment paper, and to what extent they hold.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bench/papers/flown.hpp"
#include "bench/papers/template.hpp"
#include "bench/world/units.hpp"

namespace canhil::papers::transfer_alignment {

struct Axis {
  std::string_view name;
  const campaign::Quantity* quantity;
  double unit;
  std::string_view format;  ///< number format of the errors in this unit
};
inline constexpr std::array axes{Axis{"roll", &quantities::attitude_roll, world::units::mrad, ".2f"},
                                 Axis{"pitch", &quantities::attitude_pitch, world::units::mrad, ".2f"},
                                 Axis{"heading", &quantities::attitude_heading, world::units::mrad, ".2f"},
                                 Axis{"north", &quantities::velocity_north, 1, ".3f"},
                                 Axis{"east", &quantities::velocity_east, 1, ".3f"},
                                 Axis{"down", &quantities::velocity_down, 1, ".3f"}};

/// The RMS over the runs of the campaign `cruise` with all eight combinations of the signs of the initial
/// errors.
std::vector<campaign::CurvePoint> all_signs(const Results& results);

/// Adds template names for the claims, and for the tables of Figs 3 to 7. Returns whether every limit is met.
bool add_claims(Names& names, const Results& results);

}  // namespace canhil::papers::transfer_alignment
