#pragma once
// The form of the aerodynamic model; airframe_table.hpp has its values. Coefficients are per rad. Rates are
// the reduced rates p b/(2V), q c/(2V), r b/(2V). Body axes are x forward, y right, z down. Moments are about
// the centre of gravity.

namespace canhil::wind {

/// Fin deflections [rad], with the signs of the control terms in the table.
struct Deflection {
  double elevator = 0, aileron = 0, rudder = 0;
  bool operator==(const Deflection&) const = default;
};

/// A closed interval.
struct Range {
  double least = 0, most = 0;
};

/// Coefficients of lift and pitching moment. Here and in Lateral, static and control terms are multiplied by
/// 1 + mach_squared M^2; rate terms are not.
struct Longitudinal {
  double constant = 0, alpha = 0, pitch_rate = 0, elevator = 0;
};
/// Coefficients of side force, rolling and yawing moment.
struct Lateral {
  double sideslip = 0, roll_rate = 0, yaw_rate = 0, aileron = 0, rudder = 0;
};
/// CD = constant + lift^2 CL^2 + sideslip^2 beta^2 + deflection^2 (de^2 + da^2 + dr^2)
///      + wave (1 + tanh((M - wave_mach)/wave_width)).
struct Drag {
  double constant = 0, lift_squared = 0, sideslip_squared = 0, deflection_squared = 0;
  double wave = 0, wave_mach = 1, wave_width = 1;
};

/// The airframe data that the model uses.
struct Airframe {
  double mass = 1;                            // [kg]
  double Ixx = 1, Iyy = 1, Izz = 1, Ixz = 0;  // [kg m^2]
  double area = 1, span = 1, chord = 1;       // [m^2], [m], [m]
  Longitudinal lift, pitch;                   // CL, Cm
  Lateral side, roll, yaw;                    // CY, Cl, Cn
  Drag drag;                                  // CD
  double mach_squared = 0;                    // compressibility
  // If alpha, beta or speed is outside its range, the model uses the limit of the range, and the estimate is
  // flagged.
  Range alpha, beta;  // [rad]
  Range speed;        // [m/s]
  double mach_most = 0;
  Range altitude;              // [m], within the atmosphere's -2 to 20 km
  double pitch_most = 0;       // |pitch|, of the Euler angles [rad]
  double deflection_most = 0;  // of each fin [rad]
};

}  // namespace canhil::wind
