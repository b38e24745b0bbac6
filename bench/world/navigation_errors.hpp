// Errors of a navigation solution. The solution is either that of a master INS, whose errors are drawn anew
// for each sample, or an initial state, whose errors are drawn once.
#pragma once

#include "bench/world/flight_record.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {

/// The output of a navigation system.
struct NavigationSolution {
  std::int64_t t_us = 0;  ///< time of validity
  Position position;
  Vector3 v_eb_n = Vector3::Zero();
  Matrix3 C_bn = Matrix3::Identity();
};

/// Errors (computed - true) along the NED axes.
struct NavigationErrorModel {
  RandomConstant position;  ///< [m]
  RandomConstant velocity;  ///< [m/s]
  RandomConstant attitude;  ///< misalignment phi [rad]: computed attitude = exp(-[phi x]) C_bn
};

/// Errors of an initial state. The heading error psi, which may be large, is a rotation about the down axis.
/// It is applied before the misalignment phi: the computed attitude is exp(-[phi x]) Rz(-psi) C_bn. So psi
/// does not change the size of the tilts.
struct InitialErrorModel : NavigationErrorModel {
  double heading_sigma = 0;      ///< sigma of psi [rad]
  double heading_magnitude = 0;  ///< added to psi with random sign [rad]
};

/// A solution with errors drawn from the model. Takes nine numbers from the stream, whatever the sigmas are.
NavigationSolution measure(const Truth& truth, const NavigationErrorModel& model, Stream& stream);

/// An initial state with errors drawn from the model. Takes eleven numbers from the stream.
NavigationSolution initial_solution(const Truth& truth, const InitialErrorModel& model, Stream& stream);

}  // namespace canhil::world
