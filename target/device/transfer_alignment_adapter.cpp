// The adapter of transfer alignment. Input: the groups SlaveImu and MasterIns; output: the groups AlignNav
// and AlignFilter.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/fix_queue.hpp"
#include "target/device/group_intake.hpp"
#include "target/device/imu_stream.hpp"
#include "target/device/tuned_adapter.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "target/estimators/transfer_alignment/history.hpp"

namespace canhil::target {
namespace {

namespace ta = transfer_alignment;
using namespace messages;

constexpr double deg = std::numbers::pi / 180;
constexpr double degph = deg / 3600;
constexpr double degprth = deg / 60;
constexpr double ug = 1e-6 * 9.80665;
constexpr double ppm = 1e-6;
constexpr double mrad = 1e-3;

constexpr std::int64_t history_us = 500'000;
constexpr std::size_t history_length = 512;          // increments; at most one arrives per millisecond
constexpr std::int64_t fix_lead_limit_us = 500'000;  // a fix further ahead of the INS is rejected
constexpr std::size_t pending_limit = 8;             // velocities that may wait for the INS

// The parameters, each in the unit that its name states. The defaults are the settings that reproduce the
// paper, except that `loop` has the recommended value, and the errors that the recommended filter considers
// are those of ordinary sensors.
struct Tuning {
  ta::Settings filter;
  std::int64_t output_interval_us = 0;
};
using Row = ParameterTable<Tuning>::Row;
constexpr bool whole = true;
constexpr bool real = false;
constexpr bool any_time = true;
constexpr bool stopped_only = false;
constexpr std::array rows{
    Row{Parameter::accel_bias_sigma_ug, 300, 0, 1e6, real, stopped_only,
        "1-sigma of the accelerometer biases at the start.",
        [](Tuning& t, double v) { t.filter.accel_bias_sigma_0.setConstant(v * ug); }},
    Row{Parameter::gyro_bias_sigma_degph, 3, 0, 1e6, real, stopped_only,
        "1-sigma of the gyro biases at the start.",
        [](Tuning& t, double v) { t.filter.gyro_bias_sigma_0.setConstant(v * degph); }},
    Row{Parameter::accel_noise_ugprthz, 50, 0, 1e6, real, any_time,
        "Density that the filter assumes for the accelerometers' white noise.",
        [](Tuning& t, double v) { t.filter.accel_noise_density = v * ug; }},
    Row{Parameter::gyro_noise_degprth, 0.125, 0, 1e4, real, any_time,
        "Density that the filter assumes for the gyros' white noise.",
        [](Tuning& t, double v) { t.filter.gyro_noise_density = v * degprth; }},
    Row{Parameter::velocity_noise_m2ps, 0.01, 1e-9, 1e4, real, any_time,
        "Density R of the master's velocity noise, in (m/s)^2 s. The filter uses the covariance R/dt, where "
        "dt is the master's period; with `closed_loop` 0 or 1, the time since the last velocity.",
        [](Tuning& t, double v) { t.filter.velocity_noise_density = v; }},
    Row{Parameter::accel_scale_factor_sigma_ppm, 300, 0, 1e5, real, stopped_only,
        "1-sigma of the accelerometers' scale factors. The filter considers this error, and the next five, "
        "but does not estimate them; only with `closed_loop` 2. The defaults are those of ordinary sensors.",
        [](Tuning& t, double v) { t.filter.accel_scale_factor_sigma = v * ppm; }},
    Row{Parameter::accel_misalignment_sigma_mrad, 0.5, 0, 100, real, stopped_only,
        "1-sigma of each misalignment of an accelerometer towards another axis.",
        [](Tuning& t, double v) { t.filter.accel_misalignment_sigma = v * mrad; }},
    Row{Parameter::gyro_scale_factor_sigma_ppm, 300, 0, 1e5, real, stopped_only,
        "1-sigma of the gyros' scale factors.",
        [](Tuning& t, double v) { t.filter.gyro_scale_factor_sigma = v * ppm; }},
    Row{Parameter::gyro_misalignment_sigma_mrad, 0.5, 0, 100, real, stopped_only,
        "1-sigma of each misalignment of a gyro towards another axis.",
        [](Tuning& t, double v) { t.filter.gyro_misalignment_sigma = v * mrad; }},
    Row{Parameter::lever_arm_sigma_m, 0.5, 0, 100, real, stopped_only,
        "1-sigma of the lever arm from the master's place to the IMU, each axis.",
        [](Tuning& t, double v) { t.filter.lever_arm_sigma = v; }},
    Row{Parameter::velocity_correlated_mps, 0.05, 0, 100, real, stopped_only,
        "1-sigma of an error of the master's velocity that is correlated in time, in addition to the white "
        "noise.",
        [](Tuning& t, double v) { t.filter.velocity_correlated_sigma = v; }},
    Row{Parameter::velocity_correlation_s, 5, 1e-3, 1e6, real, stopped_only,
        "Correlation time of `velocity_correlated_mps`.",
        [](Tuning& t, double v) { t.filter.velocity_correlation_s = v; }},
    Row{Parameter::h2_case, 2, 1, 4, whole, stopped_only,
        "`robust_h2`: structure of the model's uncertainty, given as the number of a case in the published "
        "paper (papers/transfer.md).",
        [](Tuning& t, double v) { t.filter.h2_case = static_cast<ta::H2Case>(std::lround(v)); }},
    Row{Parameter::h2_alpha_rule, 0, 0, 1, whole, stopped_only,
        "`robust_h2`: how the filter finds alpha, the size of the uncertainty. 0: from the attitude "
        "covariance; 1: alpha is the constant `h2_alpha_mps2`.",
        [](Tuning& t, double v) { t.filter.alpha_rule = static_cast<ta::AlphaRule>(std::lround(v)); }},
    Row{Parameter::h2_alpha_mps2, 0, 0, 1e3, real, any_time, "`robust_h2`: alpha if `h2_alpha_rule` is 1.",
        [](Tuning& t, double v) { t.filter.alpha_constant = v; }},
    Row{Parameter::fading_per_s, 0, 0, 10, real, any_time,
        "`kalman`: fading memory. During a time t the sigmas grow by the factor exp(`fading_per_s` t). 0: no "
        "fading.",
        [](Tuning& t, double v) { t.filter.fading_per_s = v; }},
    Row{Parameter::mechanization, 1, 0, 1, whole, stopped_only,
        "Mechanisation. 0: it uses each sample alone and assumes constant rate and specific force, as the "
        "published test vectors do; 1: it uses two samples and corrects coning and sculling.",
        [](Tuning& t, double v) {
          t.filter.mechanization = static_cast<strapdown::Mechanization>(std::lround(v));
        }},
    Row{Parameter::closed_loop, 2, 0, 2, whole, stopped_only,
        "0: the INS is not corrected. 1: the INS is corrected as published. 2: the INS is corrected by the "
        "feedback of an invariant error. With 2, the filter refuses velocities beyond `gate_nis`. With 2, "
        "`robust_h2` makes a Kalman step if the step of `robust_h2` would make the attitude covariance "
        "larger than at the start.",
        [](Tuning& t, double v) { t.filter.loop = static_cast<ta::Loop>(std::lround(v)); }},
    Row{Parameter::gate_nis, 2000, 0, 1e9, real, any_time,
        "Only with `closed_loop` 2: velocities whose normalised innovation squared (NIS) is larger than this "
        "value are refused. 0: no gate.",
        [](Tuning& t, double v) { t.filter.gate_nis = v; }},
    Row{Parameter::gate_recovery, 5, 0, 1e6, whole, any_time,
        "The gate refuses at most this number of velocities in a row. The filter uses the next velocity even "
        "if it is beyond the gate.",
        [](Tuning& t, double v) { t.filter.gate_recovery = static_cast<std::uint32_t>(std::lround(v)); }},
    Row{Parameter::output_interval_ms, 10, 1, 1000, real, any_time,
        "Minimum time between navigation answers.",
        [](Tuning& t, double v) { t.output_interval_us = std::llround(v * 1e3); }},
};

class TransferAlignmentAdapter final : public TunedAdapter<Tuning> {
 public:
  TransferAlignmentAdapter() : TunedAdapter(rows) {}

  [[nodiscard]] Estimator estimator() const override { return Estimator::transfer_alignment; }

  bool reset(Algorithm algorithm) override {
    if (algorithm != Algorithm::kalman && algorithm != Algorithm::robust_h2) return false;
    reset_parameters();
    tuning_.filter.algorithm =
        algorithm == Algorithm::kalman ? ta::Algorithm::kalman : ta::Algorithm::robust_h2;
    imu_.reset();
    master_group_.discard();
    return true;
  }

  void start(const InitialState& initial) override {
    ta::Settings& filter = tuning_.filter;
    filter.velocity_sigma_0.setConstant(initial.velocity_sigma);
    filter.attitude_sigma_0 = {initial.tilt_sigma, initial.tilt_sigma, initial.heading_sigma};
    filter.velocity_period = 1e-6 * static_cast<double>(MasterInsVelocityD::info.cycle_time_us);
    state_ = ta::initial(nav_of(initial), filter);
    history_.restart(initial.t_us);
    imu_.start(initial.t_us, tuning_.output_interval_us);
    pending_.clear();
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    const auto step = [this](const strapdown::ImuIncrement& imu, std::int64_t t_us) {
      history_.propagate(state_, imu, t_us, tuning_.filter);
    };
    if (const auto health = imu_.receive(frame, counter, context, step, [&] { return on_imu(context); }))
      return *health;
    switch (frame.id) {
      case MasterInsVelocityNE::info.id:
        return put<MasterInsVelocityNE>(frame, counter, context);
      case MasterInsAttitude::info.id:
        return put<MasterInsAttitude>(frame, counter, context);
      case MasterInsLatitude::info.id:
        return put<MasterInsLatitude>(frame, counter, context);
      case MasterInsLongitude::info.id:
        return put<MasterInsLongitude>(frame, counter, context);
      case MasterInsVelocityD::info.id:
        return put<MasterInsVelocityD>(frame, counter, context);
      default:
        return Health::good;
    }
  }

  Health tick(Context context) override { return imu_.tick(context); }

 private:
  using MasterGroup = SampleGroup<MasterInsVelocityNE, MasterInsAttitude, MasterInsLatitude,
                                  MasterInsLongitude, MasterInsVelocityD>;

  template <class Message>
  Health put(const Frame& frame, std::uint8_t counter, Context context) {
    if (completes<Message>(master_group_, frame, counter, context)) return on_group(master_group_, context);
    return Health::good;
  }

  Health on_imu(Context context) {
    if (!state_.ins.nav.v_eb_n.allFinite() || !state_.ins.nav.C_bn.allFinite()) return numeric_fault(context);
    const Health health =
        pending_.reached(imu_.now_us(), [&](const At<Eigen::Vector3d>& fix) { return update(fix, context); });
    if (imu_.answer_is_due(tuning_.output_interval_us)) {
      imu_.answer<AlignAttitude, AlignVelocityNE, AlignVelocityD>(best_estimate().nav, context.answers);
    }
    return health;
  }

  Health on_group(const MasterGroup& group, Context context) {
    const auto& horizontal = group.get<MasterInsVelocityNE>();
    const auto& vertical = group.get<MasterInsVelocityD>();
    const At<Eigen::Vector3d> fix{
        .t_us = unwrap_us(vertical.time_of_validity_us, context.now_us),
        .counter = group.counter(),
        .value = {horizontal.velocity_north_mps, horizontal.velocity_east_mps, vertical.velocity_down_mps}};
    if (horizontal.velocity_validity != Validity::valid || fix.t_us - imu_.now_us() > fix_lead_limit_us) {
      drop_group(context);
      return Health::good;
    }
    if (fix.t_us <= imu_.now_us()) return update(fix, context);
    if (!pending_.push(fix)) drop_group(context);
    return Health::good;
  }

  Health update(const At<Eigen::Vector3d>& fix, Context& context) {
    const ta::UpdateResult result = history_.update(state_, fix.value, fix.t_us, tuning_.filter);
    switch (result.outcome) {
      case ta::Outcome::ok:
        context.consistency.distrust(result.degraded);
        [[fallthrough]];
      case ta::Outcome::gated:
        observe(result, context.consistency);
        answer_filter(fix, result, context);
        return Health::good;
      case ta::Outcome::non_finite:
      case ta::Outcome::not_positive_definite:
        return numeric_fault(context);
      case ta::Outcome::no_interval:
      case ta::Outcome::not_reached:
      case ta::Outcome::out_of_order:
      case ta::Outcome::older_than_history:
        break;
    }
    ++context.losses.late;
    return Health::good;
  }

  // Returns the INS itself in a closed loop. In an open loop, returns a copy corrected by the estimated
  // errors.
  const ta::Ins& best_estimate() {
    if (tuning_.filter.loop != ta::Loop::open) return state_.ins;
    corrected_ = ta::estimate(state_);
    return corrected_;
  }

  void answer_filter(const At<Eigen::Vector3d>& fix, const ta::UpdateResult& result, Context& context) {
    Answers& answers = context.answers;
    const ta::Covariance P =
        tuning_.filter.loop == ta::Loop::invariant ? ta::reported_covariance(state_) : state_.P;
    const ta::StateVector sigma = P.diagonal().cwiseMax(0).cwiseSqrt();
    const auto correlation = [&](int i, int j) {
      const double product = sigma(ta::attitude_state + i) * sigma(ta::attitude_state + j);
      return product > 0 ? P(ta::attitude_state + i, ta::attitude_state + j) / product : 0.0;
    };
    const ta::Ins& ins = best_estimate();
    answers.send(AlignInnovation{.innovation_north_mps = result.innovation.x(),
                                 .innovation_east_mps = result.innovation.y(),
                                 .innovation_down_mps = result.innovation.z()});
    answers.send(AlignAttitudeSigma{.attitude_sigma_north_rad = sigma(ta::attitude_state),
                                    .attitude_sigma_east_rad = sigma(ta::attitude_state + 1),
                                    .attitude_sigma_down_rad = sigma(ta::attitude_state + 2)});
    answers.send(AlignAttitudeCorrelation{.attitude_correlation_ne = correlation(0, 1),
                                          .attitude_correlation_nd = correlation(0, 2),
                                          .attitude_correlation_ed = correlation(1, 2)});
    answers.send(AlignVelocitySigma{.velocity_sigma_north_mps = sigma(ta::velocity_state),
                                    .velocity_sigma_east_mps = sigma(ta::velocity_state + 1),
                                    .velocity_sigma_down_mps = sigma(ta::velocity_state + 2),
                                    .degraded = static_cast<std::uint8_t>(context.consistency.degraded())});
    answers.send(AlignGyroBias{.gyro_bias_x_degph = ins.gyro_bias.x() / degph,
                               .gyro_bias_y_degph = ins.gyro_bias.y() / degph,
                               .gyro_bias_z_degph = ins.gyro_bias.z() / degph});
    answers.send(AlignGyroBiasSigma{.gyro_bias_sigma_x_degph = sigma(ta::gyro_bias_state) / degph,
                                    .gyro_bias_sigma_y_degph = sigma(ta::gyro_bias_state + 1) / degph,
                                    .gyro_bias_sigma_z_degph = sigma(ta::gyro_bias_state + 2) / degph});
    answers.send(AlignAccelBias{.accel_bias_x_ug = ins.accel_bias.x() / ug,
                                .accel_bias_y_ug = ins.accel_bias.y() / ug,
                                .accel_bias_z_ug = ins.accel_bias.z() / ug});
    answers.send(AlignAccelBiasSigma{.accel_bias_sigma_x_ug = sigma(ta::accel_bias_state) / ug,
                                     .accel_bias_sigma_y_ug = sigma(ta::accel_bias_state + 1) / ug,
                                     .accel_bias_sigma_z_ug = sigma(ta::accel_bias_state + 2) / ug});
    answers.send(
        AlignUpdate{.cause_time_us = wrap_us(fix.t_us), .cause_counter = fix.counter, .nis = result.nis});
  }

  ImuStream imu_;
  MasterGroup master_group_;
  ta::State state_;
  ta::Ins corrected_;
  ta::History<history_length> history_{0, history_us};
  FixQueue<Eigen::Vector3d, pending_limit> pending_;
};

}  // namespace

std::unique_ptr<Adapter> make_transfer_alignment_adapter() {
  return std::make_unique<TransferAlignmentAdapter>();
}

}  // namespace canhil::target
