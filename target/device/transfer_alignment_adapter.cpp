// Transfer alignment behind the bus: groups SlaveImu and MasterIns in, groups AlignNav and AlignFilter out.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/parameter_table.hpp"
#include "target/estimators/strapdown/attitude.hpp"
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
constexpr double us = 1e-6;

constexpr std::size_t history_length = 64;           // 320 ms at 5 ms
constexpr std::int64_t bridge_limit_us = 200'000;    // a longer gap of the IMU ends the alignment
constexpr std::int64_t silence_limit_us = 500'000;   // an IMU that stays away this long is named
constexpr std::int64_t fix_lead_limit_us = 500'000;  // a fix valid further ahead of the INS is nonsense
constexpr std::size_t pending_limit = 8;             // fixes ahead of the INS that are kept

// Parameters in the unit of their name; defaults are the settings of the paper's reproduction.
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
        [](Tuning& t, double v) { t.filter.accel_bias_sigma_0.setConstant(v * ug); }},
    Row{Parameter::gyro_bias_sigma_degph, 3, 0, 1e6, real, stopped_only,
        [](Tuning& t, double v) { t.filter.gyro_bias_sigma_0.setConstant(v * degph); }},
    Row{Parameter::accel_noise_ugprthz, 50, 0, 1e6, real, any_time,
        [](Tuning& t, double v) { t.filter.accel_noise_density = v * ug; }},
    Row{Parameter::gyro_noise_degprth, 0.125, 0, 1e4, real, any_time,
        [](Tuning& t, double v) { t.filter.gyro_noise_density = v * degprth; }},
    Row{Parameter::velocity_noise_m2ps, 0.01, 1e-9, 1e4, real, any_time,
        [](Tuning& t, double v) { t.filter.velocity_noise_density = v; }},
    Row{Parameter::h2_case, 2, 1, 4, whole, stopped_only,
        [](Tuning& t, double v) { t.filter.h2_case = static_cast<ta::H2Case>(std::lround(v)); }},
    Row{Parameter::h2_alpha_rule, 0, 0, 1, whole, stopped_only,
        [](Tuning& t, double v) { t.filter.alpha_rule = static_cast<ta::AlphaRule>(std::lround(v)); }},
    Row{Parameter::h2_alpha_mps2, 0, 0, 1e3, real, any_time,
        [](Tuning& t, double v) { t.filter.alpha_constant = v; }},
    Row{Parameter::fading_per_s, 0, 0, 10, real, any_time,
        [](Tuning& t, double v) { t.filter.fading_per_s = v; }},
    Row{Parameter::mechanization, 1, 0, 1, whole, stopped_only,
        [](Tuning& t, double v) {
          t.filter.mechanization = static_cast<strapdown::Mechanization>(std::lround(v));
        }},
    Row{Parameter::closed_loop, 1, 0, 1, whole, stopped_only,
        [](Tuning& t, double v) { t.filter.closed_loop = v > 0.5; }},
    Row{Parameter::output_interval_ms, 10, 1, 1000, real, any_time,
        [](Tuning& t, double v) { t.output_interval_us = std::llround(v * 1e3); }},
};

// What the bus said when.
template <class Value>
struct At {
  std::int64_t t_us = 0;
  std::uint8_t counter = 0;
  Value value{};
};

class TransferAlignmentAdapter final : public Adapter {
 public:
  [[nodiscard]] Estimator estimator() const override { return Estimator::transfer_alignment; }

  bool reset(Algorithm algorithm) override {
    if (algorithm != Algorithm::kalman && algorithm != Algorithm::robust_h2) return false;
    parameters_.reset(tuning_);
    tuning_.filter.algorithm =
        algorithm == Algorithm::kalman ? ta::Algorithm::kalman : ta::Algorithm::robust_h2;
    imu_group_.discard();
    master_group_.discard();
    return true;
  }

  ParameterStatus set(Parameter parameter, double value, bool running) override {
    return parameters_.set(tuning_, parameter, value, running);
  }
  [[nodiscard]] std::optional<double> get(Parameter parameter) const override {
    return parameters_.get(parameter);
  }

  void start(const InitialState& initial) override {
    ta::Settings& filter = tuning_.filter;
    filter.velocity_sigma_0.setConstant(initial.velocity_sigma);
    filter.attitude_sigma_0 = {initial.tilt_sigma, initial.tilt_sigma, initial.heading_sigma};
    state_ = ta::initial({.C_bn = strapdown::dcm_from_euler({initial.roll, initial.pitch, initial.heading}),
                          .v_eb_n = {initial.v_north, initial.v_east, initial.v_down},
                          .latitude = initial.latitude,
                          .longitude = initial.longitude,
                          .height = initial.height},
                         filter);
    history_ = ta::History<history_length>(initial.t_us);
    ins_us_ = initial.t_us;
    answered_us_ = initial.t_us - tuning_.output_interval_us;
    previous_ = {};
    pending_count_ = 0;
    coasting_ = false;
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    switch (frame.id) {
      case SlaveImuDeltaTheta::info.id:
        return put<SlaveImuDeltaTheta>(imu_group_, frame, counter, context);
      case SlaveImuDeltaV::info.id:
        return put<SlaveImuDeltaV>(imu_group_, frame, counter, context);
      case SlaveImuStatus::info.id:
        return put<SlaveImuStatus>(imu_group_, frame, counter, context);
      case MasterInsVelocityNE::info.id:
        return put<MasterInsVelocityNE>(master_group_, frame, counter, context);
      case MasterInsAttitude::info.id:
        return put<MasterInsAttitude>(master_group_, frame, counter, context);
      case MasterInsLatitude::info.id:
        return put<MasterInsLatitude>(master_group_, frame, counter, context);
      case MasterInsLongitude::info.id:
        return put<MasterInsLongitude>(master_group_, frame, counter, context);
      case MasterInsVelocityD::info.id:
        return put<MasterInsVelocityD>(master_group_, frame, counter, context);
      default:
        return Health::good;
    }
  }

  Health tick(Context context) override {
    if (context.now_us - ins_us_ <= silence_limit_us) return Health::good;
    context.errors.input_silent = true;
    return Health::fault;
  }

 private:
  using ImuGroup = SampleGroup<SlaveImuDeltaTheta, SlaveImuDeltaV, SlaveImuStatus>;
  using MasterGroup = SampleGroup<MasterInsVelocityNE, MasterInsAttitude, MasterInsLatitude,
                                  MasterInsLongitude, MasterInsVelocityD>;

  template <class Message, class Group>
  Health put(Group& group, const Frame& frame, std::uint8_t counter, Context context) {
    switch (group.put(from_frame<Message>(frame), counter)) {
      case Group::Outcome::complete:
        return on_group(group, context);
      case Group::Outcome::dropped_previous:
        drop_group(context);
        break;
      case Group::Outcome::waiting:
        break;
    }
    return Health::good;
  }

  static void drop_group(Context& context) {
    ++context.losses.bad_group;
    context.errors.input_lost = true;
  }

  Health on_group(const ImuGroup& group, Context context) {
    const auto& theta = group.get<SlaveImuDeltaTheta>();
    const auto& velocity = group.get<SlaveImuDeltaV>();
    const auto& status = group.get<SlaveImuStatus>();
    const strapdown::ImuIncrement imu{
        .delta_theta = {theta.delta_theta_x_rad, theta.delta_theta_y_rad, theta.delta_theta_z_rad},
        .delta_v = {velocity.delta_v_x_mps, velocity.delta_v_y_mps, velocity.delta_v_z_mps},
        .dt = status.interval_us * us};
    const std::int64_t t_us = unwrap_us(status.time_of_validity_us, context.now_us);
    if (theta.gyro_validity != Validity::valid || velocity.accel_validity != Validity::valid ||
        !(imu.dt > 0)) {
      drop_group(context);  // the gap that it leaves is bridged by the next group
      return Health::good;
    }
    const auto interval_us = static_cast<std::int64_t>(status.interval_us);
    const std::int64_t gap_us = t_us - interval_us - ins_us_;
    if (gap_us <= -interval_us / 2) {
      ++context.losses.late;
      return Health::good;
    }
    if (gap_us > bridge_limit_us) {
      context.errors.input_silent = true;
      return Health::fault;
    }
    if (gap_us >= interval_us / 2) bridge(imu, gap_us, interval_us, context);
    step(imu, t_us);
    if (!state_.ins.nav.v_eb_n.allFinite() || !state_.ins.nav.C_bn.allFinite()) return numeric_fault(context);
    const Health health = update_pending(context);
    // An interval of IMU samples need not divide the output interval: half a sample early is in time.
    if (t_us - answered_us_ >= tuning_.output_interval_us - interval_us / 2) {
      answered_us_ = t_us;
      answer_navigation(t_us, group.counter(), context.answers);
    }
    return health;
  }

  // A gap is bridged with the mean of the increments before and after it, at their rate, and reported as
  // coasting.
  void bridge(const strapdown::ImuIncrement& after, std::int64_t gap_us, std::int64_t interval_us,
              Context& context) {
    coasting_ = true;
    context.errors.input_lost = true;
    const std::int64_t missing = std::max<std::int64_t>(1, (gap_us + interval_us / 2) / interval_us);
    const strapdown::ImuIncrement before = previous_.dt > 0 ? previous_ : after;
    const double dt = static_cast<double>(gap_us) * us / static_cast<double>(missing);
    const strapdown::ImuIncrement mean{
        .delta_theta = (before.delta_theta / before.dt + after.delta_theta / after.dt) * (dt / 2),
        .delta_v = (before.delta_v / before.dt + after.delta_v / after.dt) * (dt / 2),
        .dt = dt};
    const std::int64_t start_us = ins_us_;
    for (std::int64_t i = 1; i <= missing; ++i) step(mean, start_us + gap_us * i / missing);
  }

  void step(const strapdown::ImuIncrement& imu, std::int64_t t_us) {
    history_.propagate(state_, imu, t_us, tuning_.filter);
    previous_ = imu;
    ins_us_ = t_us;
  }

  Health on_group(const MasterGroup& group, Context context) {
    const auto& horizontal = group.get<MasterInsVelocityNE>();
    const auto& vertical = group.get<MasterInsVelocityD>();
    const At<Eigen::Vector3d> fix{
        .t_us = unwrap_us(vertical.time_of_validity_us, context.now_us),
        .counter = group.counter(),
        .value = {horizontal.velocity_north_mps, horizontal.velocity_east_mps, vertical.velocity_down_mps}};
    if (horizontal.velocity_validity != Validity::valid || fix.t_us - ins_us_ > fix_lead_limit_us) {
      drop_group(context);
      return Health::good;
    }
    if (fix.t_us > ins_us_) {  // ahead of the INS: kept until the IMU gets there
      if (pending_count_ < pending_limit) {
        pending_[pending_count_++] = fix;
      } else {
        drop_group(context);
      }
      return Health::good;
    }
    return update(fix, context);
  }

  // The fixes that waited and that the INS has reached now, in their order.
  Health update_pending(Context& context) {
    std::size_t reached = 0;
    Health health = Health::good;
    while (reached < pending_count_ && pending_[reached].t_us <= ins_us_ && health == Health::good)
      health = update(pending_[reached++], context);
    if (reached == 0) return health;
    std::move(pending_.begin() + static_cast<std::ptrdiff_t>(reached),
              pending_.begin() + static_cast<std::ptrdiff_t>(pending_count_), pending_.begin());
    pending_count_ -= reached;
    return health;
  }

  Health update(const At<Eigen::Vector3d>& fix, Context& context) {
    const ta::UpdateResult result = history_.update(state_, fix.value, fix.t_us, tuning_.filter);
    switch (result.outcome) {
      case ta::Outcome::ok:
        answer_filter(fix, result, context.answers);
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

  static Health numeric_fault(Context& context) {
    context.errors.numeric = true;
    return Health::fault;
  }

  // In a closed loop the INS itself; in an open one it is corrected for each answer.
  const ta::Ins& best_estimate() {
    if (tuning_.filter.closed_loop) return state_.ins;
    corrected_ = ta::estimate(state_);
    return corrected_;
  }

  void answer_navigation(std::int64_t t_us, std::uint8_t counter, Answers& answers) {
    const ta::Ins& ins = best_estimate();
    const strapdown::NavState& nav = ins.nav;
    const strapdown::Euler angles = strapdown::euler_from_dcm(nav.C_bn);
    answers.send(AlignAttitude{.roll_deg = angles.roll / deg,
                               .pitch_deg = angles.pitch / deg,
                               .heading_deg = angles.heading / deg,
                               .coasting = static_cast<std::uint8_t>(coasting_)});
    answers.send(AlignVelocityNE{
        .velocity_north_mps = nav.v_eb_n.x(), .velocity_east_mps = nav.v_eb_n.y(), .cause_counter = counter});
    answers.send(AlignVelocityD{.velocity_down_mps = nav.v_eb_n.z(), .cause_time_us = wrap_us(t_us)});
    coasting_ = false;
  }

  void answer_filter(const At<Eigen::Vector3d>& fix, const ta::UpdateResult& result, Answers& answers) {
    const ta::StateVector sigma = state_.P.diagonal().cwiseMax(0).cwiseSqrt();
    const auto correlation = [&](int i, int j) {
      const double product = sigma(ta::attitude_state + i) * sigma(ta::attitude_state + j);
      return product > 0 ? state_.P(ta::attitude_state + i, ta::attitude_state + j) / product : 0.0;
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
                                    .velocity_sigma_down_mps = sigma(ta::velocity_state + 2)});
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

  ParameterTable<Tuning> parameters_{rows};
  Tuning tuning_;
  ImuGroup imu_group_;
  MasterGroup master_group_;
  ta::State state_;
  ta::Ins corrected_;
  ta::History<history_length> history_{0};
  std::int64_t ins_us_ = 0;       // epoch of the INS
  std::int64_t answered_us_ = 0;  // epoch of the last navigation answer
  strapdown::ImuIncrement previous_;
  std::array<At<Eigen::Vector3d>, pending_limit> pending_;  // fixes ahead of the INS, as they came
  std::size_t pending_count_ = 0;
  bool coasting_ = false;
};

}  // namespace

std::unique_ptr<Adapter> make_transfer_alignment_adapter() {
  return std::make_unique<TransferAlignmentAdapter>();
}

}  // namespace canhil::target
