#pragma once
// The measurement update, as scalar updates one after another: exact for the uncorrelated noises of a sample,
// without inverse or factorisation; and the H-infinity step behind it in the same form.
#include "target/estimators/wind/model.hpp"

namespace canhil::wind {

struct Correction {
  StateVector dx = StateVector::Zero();
  Covariance P;
  Observation normalised;  // whitened: each less what those before it tell of it, over its own sigma; rates,
                           // angles and velocity in their places, the velocity last in order
  double nis = 0;  // innovation' S^-1 innovation, the sum of their squares: chi-square of 9 if consistent
  double determinant = 1;  // of S, in the units of the innovation
};

/// The Kalman update of P by an observation of the given innovation, noise variances diagonal; of the
/// sensitivity S+ = (I - K H) S, if there is one.
Correction corrected(const Covariance& P, const Observation& innovation, const GroundVelocity& at,
                     const Observation& noise_variance, Sensitivity* sensitivity = nullptr);

/// The largest theta, at most the one given, with theta lambda_max(S^1/2 L P L' S^1/2) <= cap; L picks the
/// air velocity and the rates, S = diag(1, 1, 1, w, w, w).
double capped_theta(double theta, double cap, const Covariance& P, double rate_weight);

/// H-infinity (Park and Park 2019, eqs. (25)-(27) without an inverse of P; NOTES.md): what the Kalman update
/// says of the air velocity and the rates is believed less, P~^-1 = P^-1 - theta L' S L, by scalar updates of
/// negative noise variance -1/(theta S_j); dx becomes P~ H' R^-1 innovation. Needs theta lambda_max < 1.
void inflate(Correction& correction, double theta, double rate_weight);

}  // namespace canhil::wind
