#pragma once
// Updates the errors by a fix, and corrects the INS by the errors.
#include "target/estimators/inflight_alignment/filter.hpp"

namespace canhil::inflight_alignment {

/// True for a filter with sine and cosine of the heading error as states.
template <int N>
constexpr bool is_sin_cos = Layout<N>::attitude_count == 4;

/// The update by a fix whose white noise has the variances `noise` [m^2], NED. The measurement is z = dR -
/// rho + noise, where rho is the fix bias (Kang, Kim, Park 2006, eq. (10)); in a filter without fix bias it
/// is z = dR + noise.
template <int N>
filtering::Correction<N, 3> correction(const Errors<N>& prior, const Eigen::Vector3d& innovation,
                                       const Eigen::Vector3d& noise);

/// The position of a navigation state.
GeodeticPosition position_of(const strapdown::NavState& nav);

/// The position minus its errors [m].
GeodeticPosition corrected(const GeodeticPosition& ins, const Eigen::Vector3d& dR);

/// The navigation state of an INS, corrected: position minus dR [m], velocity minus dV [m/s], and the
/// attitude turned to the computer frame by C_pc.
strapdown::NavState corrected(const strapdown::NavState& nav, const Eigen::Vector3d& dR,
                              const Eigen::Vector3d& dV, const Eigen::Matrix3d& C_pc);

}  // namespace canhil::inflight_alignment
