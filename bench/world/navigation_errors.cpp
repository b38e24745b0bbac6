#include "bench/world/navigation_errors.hpp"

namespace canhil::world {
namespace {

struct Errors {
  Vector3 position;
  Vector3 velocity;
  Vector3 phi;
};

Errors draw(const NavigationErrorModel& model, Stream& stream) {
  const Vector3 position = draw(model.position, stream);
  const Vector3 velocity = draw(model.velocity, stream);
  return {.position = position, .velocity = velocity, .phi = draw(model.attitude, stream)};
}

NavigationSolution with(const Errors& errors, const Truth& truth, const Matrix3& C_bn) {
  return {.t_us = truth.t_us,
          .position = displaced(truth.position, errors.position),
          .v_eb_n = truth.v_eb_n + errors.velocity,
          .C_bn = misaligned(C_bn, errors.phi)};
}

}  // namespace

NavigationSolution measure(const Truth& truth, const NavigationErrorModel& model, Stream& stream) {
  return with(draw(model, stream), truth, truth.C_bn);
}

NavigationSolution initial_solution(const Truth& truth, const InitialErrorModel& model, Stream& stream) {
  const Errors errors = draw(model, stream);
  const double drawn = model.heading_sigma * stream.normal();
  const double side = stream.uniform() < 0.5 ? -1.0 : 1.0;
  const Vector3 psi(0, 0, drawn + side * model.heading_magnitude);
  return with(errors, truth, misaligned(truth.C_bn, psi));
}

}  // namespace canhil::world
