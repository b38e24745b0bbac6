#include "target/estimators/strapdown/attitude.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace canhil::strapdown {

Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& phi) {
  const double x = phi.squaredNorm();
  double a;        // sin |phi| / |phi|
  double b;        // (1 - cos |phi|) / |phi|^2
  if (x < 0.01) {  // the first omitted term is below 3e-18
    a = 1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72)));
    b = 0.5 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90))));
  } else {
    const double angle = std::sqrt(x);
    const double half = std::sin(angle / 2);
    a = std::sin(angle) / angle;
    b = 2 * half * half / x;
  }
  // I + a [phi x] + b [phi x]^2, and [phi x]^2 = phi phi' - |phi|^2 I
  const double c = 1 - b * x;
  const Eigen::Vector3d s = a * phi;
  const Eigen::Vector3d p = b * phi;
  Eigen::Matrix3d m;
  m << c + p.x() * phi.x(), p.x() * phi.y() - s.z(), p.x() * phi.z() + s.y(),  //
      p.x() * phi.y() + s.z(), c + p.y() * phi.y(), p.y() * phi.z() - s.x(),   //
      p.x() * phi.z() - s.y(), p.y() * phi.z() + s.x(), c + p.z() * phi.z();
  return m;
}

Eigen::Vector3d log_rotation(const Eigen::Matrix3d& C) {
  const Eigen::AngleAxisd rotation(C);
  return rotation.angle() * rotation.axis();
}

Eigen::Vector3d misalignment(const Eigen::Matrix3d& C_computed, const Eigen::Matrix3d& C_true) {
  return -log_rotation(C_computed * C_true.transpose());
}

Eigen::Matrix3d dcm_from_euler(const Euler& e) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(e.heading, Vector3d::UnitZ()) * AngleAxisd(e.pitch, Vector3d::UnitY()) *
          AngleAxisd(e.roll, Vector3d::UnitX()))
      .toRotationMatrix();
}

Euler euler_from_dcm(const Eigen::Matrix3d& C) {
  return {std::atan2(C(2, 1), C(2, 2)), std::atan2(-C(2, 0), std::hypot(C(2, 1), C(2, 2))),
          std::atan2(C(1, 0), C(0, 0))};
}

Eigen::Matrix3d reorthonormalised(const Eigen::Matrix3d& C) {
  const Eigen::Matrix3d gram = C.transpose() * C;
  return 1.5 * C - 0.5 * C * gram;
}

}  // namespace canhil::strapdown
