#pragma once
// Settings and airframe, and constants derived from them.
#include <Eigen/Core>

#include "target/estimators/wind/airframe_table.hpp"
#include "target/estimators/wind/settings.hpp"

namespace canhil::wind {

/// What a filter needs in each step.
struct Design {
  Settings settings;
  Airframe airframe;
  Eigen::Matrix3d inertia, inertia_inverse;  // [kg m^2], -Ixz off the diagonal
};

/// The design for settings and an airframe; call it at start-up.
Design make_design(const Settings& settings, const Airframe& airframe = airframe_table);

}  // namespace canhil::wind
