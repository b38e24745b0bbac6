#pragma once
// In-flight alignment of an INS by position fixes from an SSBL or GPS, with a heading error of any size
// (Kang, Kim, Park 2006, and a filter that is linear in that error). Call initial() once, propagate() at IMU
// rate, update() at each fix.
#include <Eigen/Core>
#include <cstdint>
#include <variant>

#include "target/estimators/filtering/mean_charts.hpp"
#include "target/estimators/inflight_alignment/error_model.hpp"
#include "target/estimators/strapdown/imu_increment.hpp"
#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::inflight_alignment {

/// The part of the state that an IMU sample changes between two predictions of the filter.
struct Ins {
  strapdown::NavState nav;
  Interval interval;        // since the last prediction
  std::uint32_t steps = 0;  // since the start
};

/// A position on WGS-84.
struct GeodeticPosition {
  double latitude = 0, longitude = 0;  // [rad]
  double height = 0;                   // above the ellipsoid [m]
};

/// A fix.
struct Fix {
  GeodeticPosition position;
  FixSigma reported;

  /// A fix that need not report sigmas.
  Fix(const GeodeticPosition& at, const FixSigma& sigma = {}) : position(at), reported(sigma) {}
};

/// What the fixes so far tell of their errors; used by the recommended filter.
struct FixErrors {
  FixSigma reported;                               // with the last used fix
  Eigen::Vector3d told = Eigen::Vector3d::Zero();  // variance of fix_bias that P contains for it, NED [m^2]
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();  // further variance that innovations showed, NED [m^2]
  double age = 0;                                  // time since the last used fix [s]
  filtering::MeanCharts<3> charts;                 // of the innovations, divided by their sigmas
};

/// All that the filter keeps between two samples.
struct State {
  Ins ins;
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  // estimate, subtracted from the IMU [m/s^2]
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   // estimate, subtracted from the IMU [rad/s]
  Eigen::Vector3d fix_bias = Eigen::Vector3d::Zero();    // estimate, subtracted from fixes, NED [m]
  std::variant<Errors<15>, Errors<16>, Errors<18>, Errors<19>> errors;  // of the INS; N from the settings
  FixErrors fixes;
  std::uint32_t updated_at = 0;  // step of the last update
  std::uint32_t rejected = 0;    // number of consecutive gated fixes
  std::uint32_t repairs = 0;     // how often P lost its positive definiteness
  bool to_be_levelled = false;   // sin_cos: the first IMU sample levels the INS
  bool handed_over = false;      // sin_cos: tilt and heading were fed back at the last fix
  bool off_circle = false;       // sin_cos: sine and cosine of the heading contradict each other
};

/// How a fix was processed.
enum class Outcome : std::uint8_t {
  ok,
  gated,                  // NIS above the gate
  no_interval,            // no IMU sample since the last update
  non_finite,             // a NaN or infinity in the fix or in the result
  not_positive_definite,  // the innovation covariance, or P has a negative variance
  not_reached,            // from History: fix valid after the newest IMU epoch
  out_of_order,           // from History: fix valid before the last update
  older_than_history,     // from History: fix valid before the oldest stored epoch
};

/// The result of an update. Unless outcome is ok, the update changed only the count of gated fixes.
struct UpdateResult {
  Outcome outcome = Outcome::no_interval;
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();  // INS - fix, minus its prediction, NED [m]
  Eigen::Matrix3d innovation_covariance = Eigen::Matrix3d::Zero();  // [m^2]
  double nis = 0;                                                   // chi-squared, 3 degrees of freedom
  GeodeticPosition position;  // best estimate at the fix's time of validity
  bool gate_opened = false;   // accepted despite a NIS above the gate
  int repairs = 0;            // how often this call repaired P
};

/// The state at the start of an alignment: `nav` is the navigation state of the INS; P0 follows from the
/// settings.
State initial(const strapdown::NavState& nav, const Settings& settings);

/// Processes one IMU increment (dt > 0): mechanisation with the estimated biases removed, and a prediction of
/// the filter when the interval without a fix reaches Settings::longest_interval.
void propagate(State& state, const strapdown::ImuIncrement& imu, const Settings& settings);

/// The first part of propagate(): only the mechanisation. The other parts are prediction_is_due() and
/// predict().
void mechanise(State& state, const strapdown::ImuIncrement& imu);
/// True if the interval without a fix has reached Settings::longest_interval.
bool prediction_is_due(const State& state, const Settings& settings);
/// Predicts the filter over the interval since its last prediction.
void predict(State& state, const Settings& settings);

/// Processes a fix valid at the last IMU epoch: prediction over the interval, measurement update, and in a
/// closed loop the correction of the INS.
UpdateResult update(State& state, const Fix& fix, const Settings& settings);

/// update() for a caller that has interpolated `ins`, the position of the INS at the fix's time of validity.
UpdateResult update(State& state, const GeodeticPosition& ins, const Fix& fix, const Settings& settings);

/// The best current estimate: the INS minus its estimated errors, which are first predicted to the last IMU
/// epoch.
struct Estimate {
  strapdown::NavState nav;
  Eigen::Vector3d accel_bias, gyro_bias, fix_bias;  // [m/s^2], [rad/s], NED [m]
};
/// The estimate after the last sample.
Estimate estimate(const State& state);

/// The uncertainty after the last update or prediction.
struct Uncertainty {
  Eigen::Vector3d position, velocity;                  // sigmas, NED [m], [m/s]
  Eigen::Matrix3d attitude;                            // covariance, small rotations about NED [rad^2]
  Eigen::Vector3d accel_bias, gyro_bias;               // sigmas, body [m/s^2], [rad/s]
  Eigen::Vector3d fix_bias = Eigen::Vector3d::Zero();  // sigmas, NED [m]
};
/// The uncertainty after the last update or prediction; that of the recommended filter includes a margin.
Uncertainty uncertainty(const State& state);

}  // namespace canhil::inflight_alignment
