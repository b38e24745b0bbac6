#include "target/estimators/inflight_alignment/fix_error.hpp"

#include <algorithm>

namespace canhil::inflight_alignment {
namespace {

using Eigen::Vector3d;

// For an error of variance 1 whose correlation time is not told. A Gauss-Markov error of the time t has the
// density 2 t/(1 + (w t)^2) at the angular frequency w, whose largest value over all t is 1/w. The sum of
// these two errors is above it from 1/120 to 1/15 rad/s (fixes at 1 Hz). At 1/5 rad/s, which matters if the
// real error has 5 s, it is 0.6 of it.
constexpr double covering_white = 1.5, covering_variance = 2, covering_time = 60;

}  // namespace

bool models_fix_errors(const Settings& settings) {
  return settings.algorithm == Algorithm::sin_cos && settings.sin_cos_form == SinCosForm::levelled;
}

FixErrorModel fix_error_model(const Settings& settings, const FixSigma& reported) {
  const double horizontal = std::max(settings.fix_noise_horizontal, reported.horizontal);
  const double vertical = std::max(settings.fix_noise_vertical, reported.vertical);
  const double h = horizontal * horizontal, v = vertical * vertical;
  const double constant =
      settings.aiding == Aiding::ssbl ? settings.fix_bias_sigma_0 * settings.fix_bias_sigma_0 : 0;
  FixErrorModel model{.white = {h, h, v}, .state = Vector3d::Constant(constant)};
  if (!models_fix_errors(settings) || !(settings.fix_correlated_share > 0)) return model;
  Vector3d correlated = settings.fix_correlated_share * model.white;
  double time = settings.fix_correlation_time;
  if (time > 0) {
    model.white -= correlated;
  } else {
    model.white += (covering_white - 1) * correlated;
    correlated *= covering_variance;
    time = covering_time;
  }
  model.state += correlated;
  model.density = 2 / time * correlated;
  return model;
}

}  // namespace canhil::inflight_alignment
