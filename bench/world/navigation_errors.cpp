#include "bench/world/navigation_errors.hpp"

namespace canhil::world {

NavigationSolution measure(const Truth& truth, const NavigationErrorModel& model, Stream& stream) {
  const Vector3 position_error = draw(model.position, stream);
  const Vector3 velocity_error = draw(model.velocity, stream);
  const Vector3 phi = draw(model.attitude, stream);
  return {.t_us = truth.t_us,
          .position = displaced(truth.position, position_error),
          .v_eb_n = truth.v_eb_n + velocity_error,
          .C_bn = misaligned(truth.C_bn, phi)};
}

}  // namespace canhil::world
