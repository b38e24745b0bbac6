#pragma once
// The measurement update as a sequence of scalar updates, exact for the uncorrelated noises of a sample,
// without inverse or factorisation; and the H-infinity step that follows it, in the same form.
#include "target/estimators/wind/model.hpp"

namespace canhil::wind {

/// The result of a measurement update.
struct Correction {
  StateVector dx = StateVector::Zero();
  Covariance P;
  // The whitened innovation: each component minus its prediction from the components processed before it.
  // This difference is divided by its sigma. Rates are processed first, then angles, then velocity.
  Observation normalised;
  double nis = 0;          // innovation' S^-1 innovation = |normalised|^2: chi-squared of 9 if consistent
  double determinant = 1;  // of S, in the units of the innovation
};

/// The Kalman update of P by an observation with the given innovation and diagonal noise variances; also
/// updates the sensitivity, S+ = (I - K H) S, if it is given.
Correction corrected(const Covariance& P, const Observation& innovation, const GroundVelocity& at,
                     const Observation& noise_variance, Sensitivity* sensitivity = nullptr);

/// The largest theta, but at most the given theta, with theta lambda_max(S^1/2 L P L' S^1/2) <= cap; L
/// selects the air velocity and the rates, S = diag(1, 1, 1, w, w, w).
double capped_theta(double theta, double cap, const Covariance& P, double rate_weight);

/// H-infinity (Park and Park 2019, eqs. (25)-(27) without an inverse of P; NOTES.md): reduces the information
/// of the Kalman update about the air velocity and the rates, P~^-1 = P^-1 - theta L' S L, by scalar updates
/// with negative noise variance -1/(theta S_j); dx becomes P~ H' R^-1 innovation. Needs theta lambda_max < 1.
void inflate(Correction& correction, double theta, double rate_weight);

}  // namespace canhil::wind
