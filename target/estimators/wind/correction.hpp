#pragma once
// The measurement update as a sequence of scalar updates. It is exact, because the noises of a sample are
// uncorrelated, and it needs no inverse and no factorisation. The H-infinity step after it has the same form.
#include "target/estimators/wind/model.hpp"

namespace canhil::wind {

/// The result of a measurement update.
struct Correction {
  StateVector dx = StateVector::Zero();
  Covariance P;
  // The whitened innovation: each component minus its prediction from the components processed before it.
  // This difference is divided by its sigma. Rates are processed first, then angles, then velocity.
  Observation normalised;
  // The variance of each component's part that lasting errors cause, which is the same in every sample,
  // divided by the variance that the noise causes.
  Observation lasting = Observation::Zero();
  double nis = 0;          // innovation' S^-1 innovation = |normalised|^2: chi-squared of 9 if consistent
  double determinant = 1;  // of S, in the units of the innovation
};

/// The Kalman update of P by an observation with the given innovation and with uncorrelated noises of the
/// given variances. If the caller passes a sensitivity, also updates it for lasting errors with the given
/// sigmas: S+ = (I - K H) S + K E, where E has the errors of navigation.
Correction corrected(const Covariance& P, const Observation& innovation, const GroundVelocity& at,
                     const Observation& noise_variance, Sensitivity* sensitivity = nullptr,
                     const LastingErrors& sigma = LastingErrors::Zero());

/// The given theta, lowered if necessary so that theta lambda_max(S^1/2 L P L' S^1/2) <= cap. L selects the
/// air velocity and the rates; S is diag(1, 1, 1, w, w, w) with the rate weight w.
double capped_theta(double theta, double cap, const Covariance& P, double rate_weight);

/// The H-infinity step after a Kalman update (Park and Park 2019, eqs. (25)-(27) without an inverse of P;
/// NOTES.md). It reduces the information about the air velocity and the rates: P~^-1 = P^-1 - theta L' S L.
/// For this it uses scalar updates with the negative noise variances -1/(theta S_j). dx becomes
/// P~ H' R^-1 innovation. Requires theta lambda_max < 1.
void inflate(Correction& correction, double theta, double rate_weight);

}  // namespace canhil::wind
