#pragma once
// The errors of fixes as the recommended filter models them: white noise, and an error that is correlated in
// time (Gauss-Markov), which the state fix_bias contains together with the constant error.
#include <cmath>

#include "target/estimators/inflight_alignment/filter.hpp"

namespace canhil::inflight_alignment {

/// Variances of the errors of a fix, NED.
struct FixErrorModel {
  Eigen::Vector3d white = Eigen::Vector3d::Zero();    // of each fix [m^2]
  Eigen::Vector3d state = Eigen::Vector3d::Zero();    // of fix_bias, as long as no fix was used [m^2]
  Eigen::Vector3d density = Eigen::Vector3d::Zero();  // of the noise that drives fix_bias [m^2/s]
};

/// The model that the settings tell for a fix with these reported sigmas. If the correlation time is not
/// told, the model covers the power spectral density of every Gauss-Markov error of this sigma with a time
/// from 15 to 120 s, and 0.6 of the one with 5 s.
FixErrorModel fix_error_model(const Settings& settings, const FixSigma& reported);

/// True for the recommended filter, sin_cos in the levelled form; the published filters take fix errors as
/// white and constant.
bool models_fix_errors(const Settings& settings);

/// Predicts fix_bias over T [s], after the last used fix: its variance tends to that which this fix told,
/// plus `seen`. Without a correlated error, fix_bias is constant.
template <int N>
void predict_fix_bias(Errors<N>& errors, FixErrors& fixes, const Settings& settings, double T) {
  using At = Layout<N>;
  if constexpr (At::has_fix_bias) {
    if (!models_fix_errors(settings)) return;
    const FixErrorModel model = fix_error_model(settings, fixes.reported);
    fixes.age += T;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(model.density(axis) > 0)) continue;
      const int i = At::fix_bias + axis;
      const double variance = model.state(axis) + fixes.seen(axis);
      const double keep = std::exp(-model.density(axis) * T / (2 * variance));
      errors.x(i) *= keep;
      errors.P.row(i) *= keep;
      errors.P.col(i) *= keep;
      errors.P(i, i) += variance * (1 - keep * keep);
      fixes.told(axis) = model.state(axis) + keep * keep * (fixes.told(axis) - model.state(axis));
    }
  }
}

}  // namespace canhil::inflight_alignment
