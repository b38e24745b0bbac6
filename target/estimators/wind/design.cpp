#include "target/estimators/wind/design.hpp"

#include <Eigen/LU>

namespace canhil::wind {

Design make_design(const Settings& settings, const Airframe& airframe) {
  Design design{settings, airframe, {}, {}};
  design.inertia << airframe.Ixx, 0, -airframe.Ixz, 0, airframe.Iyy, 0, -airframe.Ixz, 0, airframe.Izz;
  design.inertia_inverse = design.inertia.inverse();
  return design;
}

}  // namespace canhil::wind
