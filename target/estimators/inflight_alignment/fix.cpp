#include "target/estimators/inflight_alignment/fix.hpp"

#include <cmath>

#include "target/estimators/strapdown/earth.hpp"

namespace canhil::inflight_alignment {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int N>
filtering::Correction<N, 3> correction(const Errors<N>& prior, const Vector3d& innovation,
                                       const Vector3d& noise) {
  const Matrix3d R = noise.asDiagonal();
  if constexpr (Layout<N>::has_fix_bias) {
    return filtering::update_state_difference<Layout<N>::position, Layout<N>::fix_bias, N, 3>(prior.P, R,
                                                                                              innovation);
  } else {
    return filtering::update_states<Layout<N>::position, N, 3>(prior.P, R, innovation);
  }
}

GeodeticPosition position_of(const strapdown::NavState& nav) {
  return {nav.latitude, nav.longitude, nav.height};
}

GeodeticPosition corrected(const GeodeticPosition& ins, const Vector3d& dR) {
  const strapdown::LocalEarth earth = strapdown::local_earth(ins.latitude, ins.height);
  const double latitude = ins.latitude - dR.x() / (earth.meridian_radius + ins.height);
  const double parallel_radius = (earth.transverse_radius + ins.height) * std::cos(latitude);
  return {latitude, ins.longitude - dR.y() / parallel_radius, ins.height + dR.z()};
}

strapdown::NavState corrected(const strapdown::NavState& nav, const Vector3d& dR, const Vector3d& dV,
                              const Matrix3d& C_pc) {
  const GeodeticPosition position = corrected(position_of(nav), dR);
  return {.C_bn = C_pc * nav.C_bn,
          .v_eb_n = nav.v_eb_n - dV,
          .latitude = position.latitude,
          .longitude = position.longitude,
          .height = position.height};
}

template filtering::Correction<15, 3> correction<15>(const Errors<15>&, const Vector3d&, const Vector3d&);
template filtering::Correction<16, 3> correction<16>(const Errors<16>&, const Vector3d&, const Vector3d&);
template filtering::Correction<18, 3> correction<18>(const Errors<18>&, const Vector3d&, const Vector3d&);
template filtering::Correction<19, 3> correction<19>(const Errors<19>&, const Vector3d&, const Vector3d&);

}  // namespace canhil::inflight_alignment
