#include "target/estimators/los_rate/motion.hpp"

#include <cmath>

namespace canhil::los_rate {

Leg bridge(const Motion& before, const Motion& after, double gap) {
  const double sigma = gap / std::sqrt(24.0);
  return {.dt = gap,
          .antenna_increment = (before.antenna_rate + after.antenna_rate) * (gap / 2),
          .roll_increment = (before.roll_rate + after.roll_rate) * (gap / 2),
          .missile_acceleration = (before.missile_acceleration + after.missile_acceleration) / 2.0,
          .turn = std::abs(after.antenna_rate - before.antenna_rate) * sigma,
          .pull = std::abs(after.missile_acceleration - before.missile_acceleration) * sigma};
}

}  // namespace canhil::los_rate
