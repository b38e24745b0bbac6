// The adapter of in-flight alignment. Input: the groups SlaveImu, Ssbl and Gps; output: the groups FixNav and
// FixFilter.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/fix_queue.hpp"
#include "target/device/group_intake.hpp"
#include "target/device/imu_stream.hpp"
#include "target/device/inflight_alignment_parameters.hpp"
#include "target/device/tuned_adapter.hpp"
#include "target/estimators/inflight_alignment/fix_error.hpp"
#include "target/estimators/inflight_alignment/history.hpp"
#include "target/estimators/strapdown/earth.hpp"

namespace canhil::target {
namespace {

namespace ia = inflight_alignment;
using namespace messages;

constexpr double deg = std::numbers::pi / 180;
constexpr double degph = deg / 3600;
constexpr double ug = 1e-6 * 9.80665;

constexpr std::int64_t history_us = 5'000'000;
constexpr std::size_t history_length = 5120;         // increments; at most one arrives per millisecond
constexpr std::int64_t outage_us = 2'000'000;        // without an update for longer, predictions are answered
constexpr std::int64_t fix_lead_limit_us = 500'000;  // a fix further ahead of the INS is rejected
constexpr std::size_t pending_limit = 4;             // fixes that may wait for the INS

struct Fix {
  FixSource source = FixSource::ssbl;
  ia::GeodeticPosition position{};
  ia::FixSigma reported{};
};

std::optional<ia::Algorithm> algorithm_of(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::ekf:
      return ia::Algorithm::ekf;
    case Algorithm::ukf:
      return ia::Algorithm::ukf;
    case Algorithm::sin_cos:
      return ia::Algorithm::sin_cos;
    default:
      return std::nullopt;
  }
}

// False for values outside the range of latitude and longitude, and at the poles.
bool on_earth(double latitude_deg, double longitude_deg) {
  return std::abs(latitude_deg) < 90 && std::abs(longitude_deg) <= 180;
}

// The largest physical value of a signal, from the DBC; the signal must exist.
template <class Message>
double maximum(std::string_view signal) {
  return std::ranges::find(Message::signals(), signal, &SignalInfo::name)->maximum;
}

class InflightAlignmentAdapter final : public TunedAdapter<InflightTuning> {
 public:
  InflightAlignmentAdapter() : TunedAdapter(inflight_alignment_parameters) {}

  [[nodiscard]] Estimator estimator() const override { return Estimator::inflight_alignment; }

  bool reset(Algorithm algorithm) override {
    const auto chosen = algorithm_of(algorithm);
    if (!chosen) return false;
    reset_parameters();
    tuning_.filter.algorithm = *chosen;
    imu_.reset();
    ssbl_group_.discard();
    gps_group_.discard();
    return true;
  }

  void start(const InitialState& initial) override {
    ia::Settings& filter = tuning_.filter;
    const double height_sigma = tuning_.height_sigma > 0 ? tuning_.height_sigma : initial.position_sigma;
    filter.position_sigma_0 = {initial.position_sigma, initial.position_sigma, height_sigma};
    filter.velocity_sigma_0.setConstant(initial.velocity_sigma);
    filter.tilt_sigma_0 = initial.tilt_sigma;
    filter.heading_sigma_0 = initial.heading_sigma;
    state_ = ia::initial(nav_of(initial), filter);
    start_us_ = updated_us_ = initial.t_us;
    history_.restart(initial.t_us);
    imu_.start(initial.t_us, tuning_.output_interval_us);
    pending_.clear();
    gated_ = refused_ = 0;
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    const auto step = [this](const strapdown::ImuIncrement& imu, std::int64_t t_us) {
      history_.propagate(state_, imu, t_us, tuning_.filter);
    };
    if (const auto health = imu_.receive(frame, counter, context, step, [&] { return on_imu(context); }))
      return *health;
    switch (frame.id) {
      case SsblRelativeNE::info.id:
        return put_ssbl<SsblRelativeNE>(frame, counter, context);
      case SsblShipLatitude::info.id:
        return put_ssbl<SsblShipLatitude>(frame, counter, context);
      case SsblShipLongitude::info.id:
        return put_ssbl<SsblShipLongitude>(frame, counter, context);
      case SsblRelativeD::info.id:
        return put_ssbl<SsblRelativeD>(frame, counter, context);
      case GpsLatitude::info.id:
        return put_gps<GpsLatitude>(frame, counter, context);
      case GpsLongitude::info.id:
        return put_gps<GpsLongitude>(frame, counter, context);
      case GpsTime::info.id:
        return put_gps<GpsTime>(frame, counter, context);
      default:
        return Health::good;
    }
  }

  Health tick(Context context) override {
    doubt(context);
    return imu_.tick(context);
  }

 private:
  // The sigmas are not valid while innovations have a lasting mean, while the estimate of the heading
  // contradicts itself, and while the heading sigma is above a limit: the axes of the reported tilts and
  // velocity may then be turned by any angle.
  void doubt(Context& context) const {
    // The sigma that sin_cos reports is 40 deg where its covariance says 30 deg.
    const double known_sigma = (tuning_.filter.algorithm == ia::Algorithm::sin_cos ? 40 : 30) * deg;
    context.consistency.distrust(state_.fixes.charts.alarmed() || state_.off_circle ||
                                 !(ia::uncertainty(state_).attitude(2, 2) <= known_sigma * known_sigma));
  }

  template <class Message>
  Health put_ssbl(const Frame& frame, std::uint8_t counter, Context& context) {
    return completes<Message>(ssbl_group_, frame, counter, context) ? on_ssbl(context) : Health::good;
  }
  template <class Message>
  Health put_gps(const Frame& frame, std::uint8_t counter, Context& context) {
    return completes<Message>(gps_group_, frame, counter, context) ? on_gps(context) : Health::good;
  }

  Health on_imu(Context& context) {
    const Health health =
        pending_.reached(imu_.now_us(), [&](const At<Fix>& fix) { return update(fix, context); });
    const strapdown::NavState best = ia::estimate(state_).nav;
    if (!best.v_eb_n.allFinite() || !best.C_bn.allFinite()) return numeric_fault(context);
    if (imu_.answer_is_due(tuning_.output_interval_us)) {
      imu_.answer<FixAttitude, FixVelocityNE, FixVelocityD>(best, context.answers);
      if (imu_.now_us() - updated_us_ > outage_us) answer_prediction(context);
    }
    return health;
  }

  // Combines the ship's position and the vehicle's position relative to the ship.
  Health on_ssbl(Context& context) {
    const auto& horizontal = ssbl_group_.get<SsblRelativeNE>();
    const auto& latitude = ssbl_group_.get<SsblShipLatitude>();
    const auto& longitude = ssbl_group_.get<SsblShipLongitude>();
    const auto& vertical = ssbl_group_.get<SsblRelativeD>();
    const bool valid = horizontal.position_validity == Validity::valid &&
                       on_earth(latitude.latitude_deg, longitude.longitude_deg) &&
                       std::abs(horizontal.relative_north_m) <= maximum<SsblRelativeNE>("relative_north_m") &&
                       std::abs(horizontal.relative_east_m) <= maximum<SsblRelativeNE>("relative_east_m") &&
                       std::abs(vertical.relative_down_m) <= maximum<SsblRelativeD>("relative_down_m");
    const double ship_latitude = latitude.latitude_deg * deg;
    const strapdown::LocalEarth earth = strapdown::local_earth(ship_latitude, latitude.height_m);
    const double parallel_radius = (earth.transverse_radius + latitude.height_m) * earth.cos_latitude;
    const Fix fix{.source = FixSource::ssbl,
                  .position = {ship_latitude +
                                   horizontal.relative_north_m / (earth.meridian_radius + latitude.height_m),
                               longitude.longitude_deg * deg + horizontal.relative_east_m / parallel_radius,
                               latitude.height_m - vertical.relative_down_m},
                  .reported = {longitude.relative_sigma_m, longitude.relative_sigma_m}};
    const std::int64_t t_us = unwrap_us(vertical.time_of_validity_us, context.now_us);
    return on_fix({t_us, ssbl_group_.counter(), fix}, valid, context);
  }

  Health on_gps(Context& context) {
    const auto& latitude = gps_group_.get<GpsLatitude>();
    const auto& longitude = gps_group_.get<GpsLongitude>();
    const bool valid = longitude.position_validity == Validity::valid &&
                       on_earth(latitude.latitude_deg, longitude.longitude_deg);
    const auto& time = gps_group_.get<GpsTime>();
    const Fix fix{.source = FixSource::gps,
                  .position = {latitude.latitude_deg * deg, longitude.longitude_deg * deg, latitude.height_m},
                  .reported = {time.horizontal_sigma_m, time.vertical_sigma_m}};
    const std::int64_t t_us = unwrap_us(time.time_of_validity_us, context.now_us);
    return on_fix({t_us, gps_group_.counter(), fix}, valid, context);
  }

  // Answers every complete group. The answer reports the effect of the fix on the filter, or the reason why
  // the fix was not used.
  Health on_fix(const At<Fix>& fix, bool valid, Context& context) {
    const FixSource chosen = tuning_.filter.aiding == ia::Aiding::gps ? FixSource::gps : FixSource::ssbl;
    if (fix.value.source != chosen) return refuse(fix, FixOutcome::wrong_source, context);
    if (!valid) {
      drop_group(context);
      return refuse(fix, FixOutcome::invalid, context);
    }
    if (fix.t_us < start_us_) return refuse(fix, FixOutcome::before_start, context);
    if (fix.t_us <= imu_.now_us()) return update(fix, context);
    if (fix.t_us - imu_.now_us() <= fix_lead_limit_us && pending_.push(fix)) return Health::good;
    drop_group(context);
    return refuse(fix, FixOutcome::future, context);
  }

  Health update(const At<Fix>& fix, Context& context) {
    const ia::UpdateResult result =
        history_.update(state_, {fix.value.position, fix.value.reported}, fix.t_us, tuning_.filter);
    doubt(context);
    switch (result.outcome) {
      case ia::Outcome::ok:
        updated_us_ = imu_.now_us();
        monitor(result, context.consistency);
        answer(fix, result.gate_opened ? FixOutcome::recovered : FixOutcome::accepted, result, state_,
               context);
        return Health::good;
      case ia::Outcome::gated:
        ++gated_;
        if (state_.rejected > 1) monitor(result, context.consistency);
        answer(fix, FixOutcome::gated, result, state_, context);
        return Health::good;
      case ia::Outcome::non_finite:
      case ia::Outcome::not_positive_definite:
        refuse(fix, FixOutcome::numeric, context);
        return numeric_fault(context);
      case ia::Outcome::older_than_history:
        ++context.losses.late;
        return refuse(fix, FixOutcome::late, context);
      case ia::Outcome::no_interval:
      case ia::Outcome::out_of_order:
      case ia::Outcome::not_reached:
        break;
    }
    ++context.losses.late;
    return refuse(fix, FixOutcome::out_of_order, context);
  }

  // The model of correlated fix errors covers many correlation times. So the innovations that it expects are
  // not white, and their means are judged by its own charts.
  void monitor(const ia::UpdateResult& result, ConsistencyMonitor& consistency) const {
    if (ia::models_fix_errors(tuning_.filter)) {
      consistency.observe_size(result.nis, 3);
    } else {
      observe(result, consistency);
    }
  }

  // Answers the last IMU sample with the prediction of the filter, whose sigmas grow while no fix is used.
  void answer_prediction(Context& context) {
    const At<Fix> cause{
        .t_us = imu_.now_us(), .counter = imu_.counter(), .value = {.source = FixSource::imu}};
    ia::State now = state_;
    ia::predict(now, tuning_.filter);
    answer(cause, FixOutcome::predicted, nothing_measured(), now, context);
  }

  // The result of an update that has not happened.
  [[nodiscard]] ia::UpdateResult nothing_measured() const {
    const strapdown::NavState now = ia::estimate(state_).nav;
    ia::UpdateResult nothing;
    nothing.position = {now.latitude, now.longitude, now.height};
    return nothing;
  }

  Health refuse(const At<Fix>& fix, FixOutcome why, Context& context) {
    ++refused_;
    answer(fix, why, nothing_measured(), state_, context);
    return Health::good;
  }

  void answer(const At<Fix>& fix, FixOutcome outcome, const ia::UpdateResult& result, const ia::State& state,
              Context& context) {
    Answers& answers = context.answers;
    const ia::Estimate best = ia::estimate(state);
    const ia::Uncertainty sigma = ia::uncertainty(state);
    const Eigen::Vector3d attitude = sigma.attitude.diagonal().cwiseMax(0).cwiseSqrt() / deg;
    answers.send(FixInnovation{.innovation_north_m = result.innovation.x(),
                               .innovation_east_m = result.innovation.y(),
                               .innovation_down_m = result.innovation.z()});
    answers.send(FixPositionLatitude{.latitude_deg = result.position.latitude / deg,
                                     .height_m = result.position.height});
    // The INS's longitude is continuous across 180 deg; the message carries -180 to 180.
    answers.send(FixPositionLongitude{
        .longitude_deg = std::remainder(result.position.longitude, 2 * std::numbers::pi) / deg});
    answers.send(FixAttitudeSigma{.tilt_sigma_north_deg = attitude.x(),
                                  .tilt_sigma_east_deg = attitude.y(),
                                  .heading_sigma_deg = attitude.z()});
    answers.send(FixVelocitySigma{.velocity_sigma_north_mps = sigma.velocity.x(),
                                  .velocity_sigma_east_mps = sigma.velocity.y(),
                                  .velocity_sigma_down_mps = sigma.velocity.z()});
    answers.send(FixPositionSigma{.position_sigma_north_m = sigma.position.x(),
                                  .position_sigma_east_m = sigma.position.y(),
                                  .position_sigma_down_m = sigma.position.z()});
    answers.send(FixGyroBias{.gyro_bias_x_degph = best.gyro_bias.x() / degph,
                             .gyro_bias_y_degph = best.gyro_bias.y() / degph,
                             .gyro_bias_z_degph = best.gyro_bias.z() / degph});
    answers.send(FixGyroBiasSigma{.gyro_bias_sigma_x_degph = sigma.gyro_bias.x() / degph,
                                  .gyro_bias_sigma_y_degph = sigma.gyro_bias.y() / degph,
                                  .gyro_bias_sigma_z_degph = sigma.gyro_bias.z() / degph});
    answers.send(FixAccelBias{.accel_bias_x_ug = best.accel_bias.x() / ug,
                              .accel_bias_y_ug = best.accel_bias.y() / ug,
                              .accel_bias_z_ug = best.accel_bias.z() / ug});
    answers.send(FixAccelBiasSigma{.accel_bias_sigma_x_ug = sigma.accel_bias.x() / ug,
                                   .accel_bias_sigma_y_ug = sigma.accel_bias.y() / ug,
                                   .accel_bias_sigma_z_ug = sigma.accel_bias.z() / ug});
    answers.send(FixBias{.fix_bias_north_m = best.fix_bias.x(),
                         .fix_bias_east_m = best.fix_bias.y(),
                         .fix_bias_down_m = best.fix_bias.z()});
    answers.send(FixBiasSigma{.fix_bias_sigma_north_m = sigma.fix_bias.x(),
                              .fix_bias_sigma_east_m = sigma.fix_bias.y(),
                              .fix_bias_sigma_down_m = sigma.fix_bias.z()});
    answers.send(FixStatus{.outcome = outcome,
                           .source = fix.value.source,
                           .handed_over = static_cast<std::uint8_t>(state_.handed_over),
                           .degraded = static_cast<std::uint8_t>(context.consistency.degraded()),
                           .repairs = static_cast<std::uint16_t>(std::min(state_.repairs, 65535U)),
                           .gated = static_cast<std::uint16_t>(std::min(gated_, 16383U)),
                           .refused = static_cast<std::uint16_t>(std::min(refused_, 16383U))});
    answers.send(
        FixUpdate{.cause_time_us = wrap_us(fix.t_us), .cause_counter = fix.counter, .nis = result.nis});
  }

  ImuStream imu_;
  SampleGroup<SsblRelativeNE, SsblShipLatitude, SsblShipLongitude, SsblRelativeD> ssbl_group_;
  SampleGroup<GpsLatitude, GpsLongitude, GpsTime> gps_group_;
  ia::State state_;
  ia::History<history_length> history_{0, history_us};
  FixQueue<Fix, pending_limit> pending_;  // fixes ahead of the INS
  std::int64_t start_us_ = 0;
  std::int64_t updated_us_ = 0;            // when the filter used a fix the last time
  std::uint32_t gated_ = 0, refused_ = 0;  // numbers of fixes since the start
};

}  // namespace

std::unique_ptr<Adapter> make_inflight_alignment_adapter() {
  return std::make_unique<InflightAlignmentAdapter>();
}

}  // namespace canhil::target
