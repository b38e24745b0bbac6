// Where a sensor is in the vehicle, which is rigid, and how it is turned: what it sees there.
#pragma once

#include "bench/world/flight_record.hpp"

namespace canhil::world {

/// The matrix from body axes to those of a sensor that is mounted with this roll, pitch and yaw [rad].
Matrix3 mounted(const Vector3& roll_pitch_yaw);

/// The velocity over ground of a point, NED [m/s]. `lever_arm`: from the body's origin to the point, body
/// axes [m]. v_ep_n = v_eb_n + C_bn (omega_eb_b x l), from the time derivative of Groves (2013), eq. (2.164).
Vector3 velocity_at(const Truth& truth, const Vector3& lever_arm);

/// The increments of an IMU at a point: the specific force there also has the Euler and the centripetal
/// acceleration, f + alpha x l + omega x (omega x l), with rates relative to inertial space. `before`,
/// `after`: the rates omega_ib_b at both ends of the interval [rad/s]. The centripetal part is integrated by
/// Simpson's rule; the rate at the middle is that of the parabola with these ends and this increment of the
/// angle.
ImuIncrement increment_at(const ImuIncrement& at_origin, const Vector3& lever_arm, const Vector3& before,
                          const Vector3& after);

}  // namespace canhil::world
