// Plays the bench for the wind estimator: the published run, 20 s at 50 Hz, one row per frame group.
#pragma once

#include <numbers>

#include "tests/unit/target/device/bench_side.hpp"
#include "tests/unit/target/estimators/wind/flown.hpp"

namespace canhil::target {

inline const wind::RecordedRun& recorded() {
  static const wind::RecordedRun run;
  return run;
}

/// Sends the initial state of the published run, or another initial state, and then rows of this run.
class Glider : public BenchSide {
 public:
  static constexpr double deg = std::numbers::pi / 180;

  struct Release {
    messages::Algorithm algorithm = messages::Algorithm::ekf;
    bool air_velocity_known = true;
    Eigen::Vector3d air_velocity = recorded().x0.head<3>();  // body [m/s]
    std::vector<messages::ParamSet> parameters;
    std::int64_t t_us = 0;
  };

  Glider() : Glider(Release{}) {}
  explicit Glider(const Release& release) : epoch_us_(release.t_us) {
    using namespace messages;
    const wind::StateVector& x0 = recorded().x0;
    const Eigen::Vector3d v_eb_n =
        wind::C_bn(x0.segment<3>(wind::attitude_at)) * x0.head<3>() + x0.segment<3>(wind::wind_at);
    command(Command::reset, Estimator::wind, release.algorithm);
    for (const ParamSet& parameter : release.parameters) send(parameter);
    sync(epoch_us_);
    send(TargetInitLatitude{.latitude_deg = 37, .height_m = recorded().altitude[0]});
    send(TargetInitLongitude{.longitude_deg = 127, .position_sigma_m = 10});
    send(TargetInitVelocityNE{.velocity_north_mps = v_eb_n.x(), .velocity_east_mps = v_eb_n.y()});
    send(TargetInitAttitude{.roll_deg = x0(6) / deg, .pitch_deg = x0(7) / deg, .heading_deg = x0(8) / deg});
    send(TargetInitSigma{.velocity_sigma_mps = 0.1, .tilt_sigma_deg = 0.1, .heading_sigma_deg = 0.1});
    send(TargetInitVelocityD{.velocity_down_mps = v_eb_n.z(), .time_of_validity_us = wrap_us(epoch_us_)});
    if (release.air_velocity_known) {
      send(TargetInitRate{
          .rate_x_degps = x0(3) / deg, .rate_y_degps = x0(4) / deg, .rate_z_degps = x0(5) / deg});
      send(TargetInitAirVelocity{.air_velocity_x_mps = release.air_velocity.x(),
                                 .air_velocity_y_mps = release.air_velocity.y(),
                                 .air_velocity_z_mps = release.air_velocity.z()});
    }
    command(Command::start, Estimator::wind, release.algorithm);
  }

  /// Sends the rows [from, to): fins, navigation, time base. `spoil` changes the frames. If `spoil` sets the
  /// time of the navigation to -1, no navigation is sent.
  void fly(
      std::size_t from, std::size_t to, const wind::Spoil& spoil = [](auto...) {}) {
    for (std::size_t k = from; k < to; ++k) {
      wind::Navigation navigation = recorded().navigation(k);
      wind::FinFrame frame{wind::RecordedRun::t_us(k), recorded().inputs[k].fins};
      spoil(k, navigation, frame);
      if (frame.arrives) fins(frame.t_us, frame.deflection);
      if (navigation.t_us >= 0) navigate(navigation);
      sync(epoch_us_ + wind::RecordedRun::t_us(k));
    }
  }
  void fins(std::int64_t t_us, const wind::Deflection& d) {
    send(messages::FinDeflections{
        .elevator_deg = d.elevator / deg,
        .aileron_deg = d.aileron / deg,
        .rudder_deg = d.rudder / deg,
        .time_of_validity_us = static_cast<double>(wrap_short_us(epoch_us_ + t_us))});
  }
  void navigate(const wind::Navigation& n) {
    using namespace messages;
    send(GliderNavVelocityNE{
        .velocity_north_mps = n.v_eb_n.x(), .velocity_east_mps = n.v_eb_n.y(), .height_m = n.altitude});
    send(GliderNavAttitude{.roll_deg = n.attitude.x() / deg,
                           .pitch_deg = n.attitude.y() / deg,
                           .heading_deg = n.attitude.z() / deg,
                           .navigation_validity = n.valid ? Validity::valid : Validity::invalid});
    send(GliderNavRates{.rate_x_degps = n.omega.x() / deg,
                        .rate_y_degps = n.omega.y() / deg,
                        .rate_z_degps = n.omega.z() / deg});
    send(GliderNavVelocityD{.velocity_down_mps = n.v_eb_n.z(),
                            .time_of_validity_us = wrap_us(epoch_us_ + n.t_us)});
  }

  /// The wind of each answer, NED [m/s].
  [[nodiscard]] std::vector<Eigen::Vector3d> winds() const {
    std::vector<Eigen::Vector3d> found;
    for (const auto& w : all<messages::WindVector>())
      found.emplace_back(w.wind_north_mps, w.wind_east_mps, w.wind_down_mps);
    return found;
  }

 private:
  std::int64_t epoch_us_;
};

}  // namespace canhil::target
