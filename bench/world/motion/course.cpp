#include "bench/world/motion/course.hpp"

#include <cmath>

namespace canhil::world {

Kinematics kinematics(const Course& course) {
  const double sh = std::sin(course.angles.heading);
  const double ch = std::cos(course.angles.heading);
  const double sp = std::sin(course.angles.pitch);
  const double cp = std::cos(course.angles.pitch);
  const Vector3 ahead(cp * ch, cp * sh, -sp);
  const Vector3 ahead_rate = course.rates.pitch * Vector3(-sp * ch, -sp * sh, -cp) +
                             course.rates.heading * Vector3(-cp * sh, cp * ch, 0);
  return {.v_eb_n = course.speed * ahead,
          .v_eb_n_rate = course.speed_rate * ahead + course.speed * ahead_rate,
          .angles = course.angles,
          .rates = course.rates};
}

}  // namespace canhil::world
