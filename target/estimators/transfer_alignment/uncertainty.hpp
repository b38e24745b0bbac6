#pragma once
// The uncertain block of the H2 filter: dA_v,phi = L Delta N bounds the effect of an unknown attitude error
// on the cross-product matrix [(C f) x].
#include <Eigen/Core>

#include "target/estimators/transfer_alignment/error_model.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

/// The factors of the uncertain block L Delta N, |Delta| <= 1.
struct Uncertainty {
  Eigen::Matrix3d L;  // on the velocity rows
  Eigen::Matrix3d N;  // of the attitude columns
  double lambda_LL;   // lmax(L L')
};

/// alpha [m/s^2]: the settings' constant, or sqrt(tr([f x] P_phi [f x]')) for the mean specific force f_n
/// [m/s^2] and the posterior P. The second value is limited to 2 sin(min(3 |sigma_0|, pi)/2) |f|, which is
/// the largest |dC f| of a 3-sigma start error.
double uncertainty_size(const Settings& settings, const Covariance& P, const Eigen::Vector3d& f_n);

/// L and N for an H2 case; lmax(S S') = 3.
Uncertainty uncertainty(H2Case h2_case, double alpha);

/// Adds the two H2 terms for a step of `duration` [s]: one to G = A dt, the other to the velocity block of
/// Q dt. Returns beta, or 0 if it added nothing. P is the posterior of the last update. SI units and radians
/// are part of the definition, as beta mixes units.
double add_h2_terms(const Uncertainty& uncertain, const Covariance& P, double duration, Covariance& G,
                    Eigen::Matrix3d& Q_velocity);

}  // namespace canhil::transfer_alignment
