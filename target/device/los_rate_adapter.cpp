// The adapter of the LOS rate estimator. Input: the group Seeker; output: the group LosRate. Answers every
// complete group.
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/group_intake.hpp"
#include "target/device/tuned_adapter.hpp"
#include "target/estimators/los_rate/filter.hpp"

namespace canhil::target {
namespace {

namespace los = los_rate;
using namespace messages;

constexpr double us = 1e-6, ms = 1e-3;
constexpr std::int64_t lead_limit_us = 100'000;     // a group further ahead of the time base is rejected
constexpr std::int64_t silence_limit_us = 500'000;  // a longer silence of the seeker is an error

// The parameters, each in the unit that its name states; the defaults are those of the estimator. The design
// is computed from the parameters at the start, so no parameter may change during a run. Within the ranges
// all designs and gains are finite.
using Tuning = los::Settings;
using Row = ParameterTable<Tuning>::Row;
constexpr bool whole = true;
constexpr bool real = false;
constexpr bool stopped_only = false;
constexpr Tuning standard;
constexpr std::array rows{
    Row{Parameter::jerk_density_m2ps5, standard.jerk_density, 1e-3, 1e6, real, stopped_only,
        "Power spectral density of the flight target's jerk.",
        [](Tuning& t, double v) { t.jerk_density = v; }},
    Row{Parameter::thermal_noise_pitch_radpm2, standard.noise.pitch.thermal, 1e-14, 1e-6, real, stopped_only,
        "Thermal noise of the error angle in pitch. The 1-sigma of a sample is this value multiplied by the "
        "square of the range. If the noises of both planes are equal, both planes use the same set of gains.",
        [](Tuning& t, double v) { t.noise.pitch.thermal = v; }},
    Row{Parameter::thermal_noise_yaw_radpm2, standard.noise.yaw.thermal, 1e-14, 1e-6, real, stopped_only,
        "The same as `thermal_noise_pitch_radpm2`, for yaw.",
        [](Tuning& t, double v) { t.noise.yaw.thermal = v; }},
    Row{Parameter::glint_noise_pitch_m, standard.noise.pitch.glint, 1e-3, 100, real, stopped_only,
        "Glint noise of the error angle in pitch. The 1-sigma of a sample is this value divided by the "
        "range.",
        [](Tuning& t, double v) { t.noise.pitch.glint = v; }},
    Row{Parameter::glint_noise_yaw_m, standard.noise.yaw.glint, 1e-3, 100, real, stopped_only,
        "The same as `glint_noise_pitch_m`, for yaw.", [](Tuning& t, double v) { t.noise.yaw.glint = v; }},
    Row{Parameter::constant_noise_pitch_rad, standard.noise.pitch.constant, 0, 0.1, real, stopped_only,
        "Range-independent noise of the error angle in pitch, 1-sigma of a sample.",
        [](Tuning& t, double v) { t.noise.pitch.constant = v; }},
    Row{Parameter::constant_noise_yaw_rad, standard.noise.yaw.constant, 0, 0.1, real, stopped_only,
        "The same as `constant_noise_pitch_rad`, for yaw.",
        [](Tuning& t, double v) { t.noise.yaw.constant = v; }},
    Row{Parameter::sample_period_ms, standard.sample_period / ms, 0.5, 50, real, stopped_only,
        "The gains are computed for this sample period of the seeker.",
        [](Tuning& t, double v) { t.sample_period = v * ms; }},
    Row{Parameter::los_rate_sigma_radps, standard.rate_sigma_0, 1e-6, 10, real, stopped_only,
        "1-sigma of the LOS rate at the start.", [](Tuning& t, double v) { t.rate_sigma_0 = v; }},
    Row{Parameter::target_acceleration_sigma_mps2, standard.acceleration_sigma_0, 1e-3, 1e4, real,
        stopped_only, "1-sigma of the flight target's acceleration at the start.",
        [](Tuning& t, double v) { t.acceleration_sigma_0 = v; }},
    Row{Parameter::start_up_s, standard.start_up, 0, 100, real, stopped_only,
        "`combined`, `switched_table`: time for which a Kalman filter runs after each start. After this time "
        "the gain comes from the tables.",
        [](Tuning& t, double v) { t.start_up = v; }},
    Row{Parameter::gap_limit_ms, standard.gap_limit / ms, 0, 1e4, real, stopped_only,
        "Longest gap of lost samples that the filter bridges by the motion measured before and after the "
        "gap. With `combined` and `switched_table`, if the error angle is missing for longer than this time, "
        "the Kalman filter runs again for `start_up_s`.",
        [](Tuning& t, double v) { t.gap_limit = v * ms; }},
    Row{Parameter::low_pass_bandwidth_radps, standard.low_pass_bandwidth, 0.1, 200, real, stopped_only,
        "`low_pass`: bandwidth of the filter.", [](Tuning& t, double v) { t.low_pass_bandwidth = v; }},
    Row{Parameter::low_pass_damping, standard.low_pass_damping, 0.1, 5, real, stopped_only,
        "`low_pass`: damping of the filter.", [](Tuning& t, double v) { t.low_pass_damping = v; }},
    Row{Parameter::range_max_m, standard.range_max, 100, 1e5, real, stopped_only,
        "`combined`: range at which the table of gains ends. A larger value makes the table coarser.",
        [](Tuning& t, double v) { t.range_max = v; }},
    Row{Parameter::closing_speed_max_mps, standard.closing_speed_max, 10, 1e4, real, stopped_only,
        "`combined`, `switched_table`: closing speed at which the table of gains ends.",
        [](Tuning& t, double v) { t.closing_speed_max = v; }},
    Row{Parameter::blind_range_m, standard.blind_range, 0, 1e4, real, stopped_only,
        "Lower limit of the least usable range. The least usable range is the largest of four values: this "
        "value; 3 times `range_sigma_m`; the closing speed times 10 sample periods; 20 m. At a smaller "
        "range, answers have the mark `blind`.",
        [](Tuning& t, double v) { t.blind_range = v; }},
    Row{Parameter::range_sigma_m, standard.range_sigma, 0, 1e3, real, stopped_only,
        "1-sigma of the measured range, bias included; see `blind_range_m`.",
        [](Tuning& t, double v) { t.range_sigma = v; }},
    Row{Parameter::range_gate_m, standard.range_gate, 1, 1e5, real, stopped_only,
        "A range that differs by more than this value from the extrapolated range is treated as a jump.",
        [](Tuning& t, double v) { t.range_gate = v; }},
    Row{Parameter::closing_speed_gate_mps, standard.closing_speed_gate, 1, 1e4, real, stopped_only,
        "A closing speed that differs by more than this value from the extrapolated closing speed is treated "
        "as a jump.",
        [](Tuning& t, double v) { t.closing_speed_gate = v; }},
    Row{Parameter::relock_samples, static_cast<double>(standard.relock_samples), 1, 1e4, whole, stopped_only,
        "After a jump of range or closing speed, the filter uses range and closing speed again when this "
        "number of samples in a row agree with each other.",
        [](Tuning& t, double v) { t.relock_samples = static_cast<int>(std::lround(v)); }},
    Row{Parameter::range_unchanged_limit_ms, standard.range_unchanged_limit / ms, 0, 1e4, real, stopped_only,
        "A range that stays exactly the same for longer than this time is treated as stale.",
        [](Tuning& t, double v) { t.range_unchanged_limit = v * ms; }},
    // The maximum is below the largest angle that the bus carries, so that a saturated angle is refused.
    Row{Parameter::field_of_view_rad, standard.field_of_view, 1e-3, 0.6, real, stopped_only,
        "Largest usable error angle. A sample with a larger error angle is refused.",
        [](Tuning& t, double v) { t.field_of_view = v; }},
    Row{Parameter::antenna_rate_sigma_radps, standard.antenna_rate_sigma, 0, 100, real, stopped_only,
        "1-sigma that the filter assumes for the antenna rate while this rate is not measured. This value "
        "makes the sigma of the answers grow while the filter coasts.",
        [](Tuning& t, double v) { t.antenna_rate_sigma = v; }},
    Row{Parameter::antenna_rate_bias_sigma_radps, 0, 0, 1, real, stopped_only,
        "`combined`: 1-sigma of a lasting error of the antenna rates. The reported sigmas allow for it.",
        [](Tuning& t, double v) { t.antenna_rate_bias_sigma = v; }},
    Row{Parameter::missile_acceleration_sigma_mps2, standard.missile_acceleration_sigma, 0, 1e4, real,
        stopped_only,
        "1-sigma that the filter assumes for the missile's acceleration while this acceleration is not "
        "measured. This value makes the sigma of the answers grow while the filter coasts.",
        [](Tuning& t, double v) { t.missile_acceleration_sigma = v; }},
};

std::optional<los::Algorithm> algorithm_of(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::switched_table:
      return los::Algorithm::switched_table;
    case Algorithm::combined:
      return los::Algorithm::combined;
    case Algorithm::kalman:
      return los::Algorithm::kalman;
    case Algorithm::low_pass:
      return los::Algorithm::low_pass;
    default:
      return std::nullopt;
  }
}

// The numerical values of outcomes and faults are the same in the estimator and on the bus.
constexpr LosRateOutcome on_bus(los::Outcome outcome) { return static_cast<LosRateOutcome>(outcome); }
constexpr LosRateFault on_bus(los::Fault fault) { return static_cast<LosRateFault>(fault); }
static_assert(on_bus(los::Outcome::waiting) == LosRateOutcome::waiting);
static_assert(on_bus(los::Outcome::started) == LosRateOutcome::started);
static_assert(on_bus(los::Outcome::updated) == LosRateOutcome::updated);
static_assert(on_bus(los::Outcome::start_up) == LosRateOutcome::start_up);
static_assert(on_bus(los::Outcome::coasting) == LosRateOutcome::coasting);
static_assert(on_bus(los::Outcome::bad_step) == LosRateOutcome::bad_step);
static_assert(on_bus(los::Outcome::non_finite) == LosRateOutcome::non_finite);
static_assert(on_bus(los::Fault::none) == LosRateFault::none);
static_assert(on_bus(los::Fault::error_angle) == LosRateFault::error_angle);
static_assert(on_bus(los::Fault::field_of_view) == LosRateFault::field_of_view);
static_assert(on_bus(los::Fault::antenna) == LosRateFault::antenna);
static_assert(on_bus(los::Fault::acceleration) == LosRateFault::acceleration);
static_assert(on_bus(los::Fault::range_invalid) == LosRateFault::range_invalid);
static_assert(on_bus(los::Fault::range_stale) == LosRateFault::range_stale);
static_assert(on_bus(los::Fault::range_jump) == LosRateFault::range_jump);
static_assert(on_bus(los::Fault::closing_speed_invalid) == LosRateFault::closing_speed_invalid);

class LosRateAdapter final : public TunedAdapter<Tuning> {
 public:
  LosRateAdapter() : TunedAdapter(rows) {}

  [[nodiscard]] Estimator estimator() const override { return Estimator::los_rate; }

  bool reset(Algorithm algorithm) override {
    const auto chosen = algorithm_of(algorithm);
    if (!chosen) return false;
    reset_parameters();
    tuning_.algorithm = *chosen;
    return true;
  }

  // The first usable sample starts the estimate. Only the time of the initial state is used: tick() needs it
  // to detect a silent seeker.
  void start(const InitialState& initial) override {
    design_ = los::make_design(tuning_);
    acquire();
    now_us_ = initial.t_us;
    group_.discard();
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    switch (frame.id) {
      case SeekerAntenna::info.id:
        return put<SeekerAntenna>(frame, counter, context);
      case SeekerAngles::info.id:
        return put<SeekerAngles>(frame, counter, context);
      case SeekerMotion::info.id:
        return put<SeekerMotion>(frame, counter, context);
      case SeekerRange::info.id:
        return put<SeekerRange>(frame, counter, context);
      default:
        return Health::good;
    }
  }

  // A silent seeker is not a fault: when samples arrive again, the estimate starts anew (acquire()).
  Health tick(Context context) override {
    if (context.now_us - now_us_ > silence_limit_us) context.errors.input_silent = true;
    return Health::good;
  }

 private:
  template <class Message>
  Health put(const Frame& frame, std::uint8_t counter, Context& context) {
    return completes<Message>(group_, frame, counter, context) ? on_group(context) : Health::good;
  }

  void acquire() {
    state_ = los::initial();
    last_ = {};
    last_.sigma.pitch.rate = last_.sigma.yaw.rate = tuning_.rate_sigma_0;
    last_.sigma.pitch.acceleration = last_.sigma.yaw.acceleration = tuning_.acceleration_sigma_0;
    tracking_ = false;
  }

  Health on_group(Context& context) {
    const std::int64_t t_us = unwrap_us(group_.get<SeekerRange>().time_of_validity_us, context.now_us);
    if (t_us - context.now_us > lead_limit_us) {
      drop_group(context);
      return refuse(t_us, context);
    }
    if (tracking_ && t_us <= now_us_) {
      ++context.losses.late;
      return refuse(t_us, context);
    }
    if (tracking_ && static_cast<double>(t_us - now_us_) * us > design_.settings.longest_step) {
      context.errors.input_silent = true;
      acquire();
    }
    const los::UpdateResult result = los::step(state_, measured(t_us), design_);
    if (result.fault != los::Fault::none) context.errors.input_lost = true;
    if (result.outcome == los::Outcome::non_finite) {
      refuse(t_us, context, result.outcome);
      context.errors.numeric = true;
      return Health::fault;
    }
    tracking_ = true;
    now_us_ = t_us;
    last_ = result;
    if (result.outcome == los::Outcome::updated || result.outcome == los::Outcome::start_up)
      observe(result, context.consistency);
    answer(t_us, result, context);
    return Health::good;
  }

  // The interval of a group should begin where the previous group ended. If the interval begins later, groups
  // were lost in between. If the interval begins earlier, the increments of the group cover more than the
  // step and are not used. The first group has no previous step.
  los::Measurement measured(std::int64_t t_us) const {
    const auto& antenna = group_.get<SeekerAntenna>();
    const auto& angles = group_.get<SeekerAngles>();
    const auto& motion = group_.get<SeekerMotion>();
    const auto& range = group_.get<SeekerRange>();
    const auto interval_us = static_cast<std::int64_t>(angles.interval_us);
    const std::int64_t missing_us = t_us - interval_us - now_us_;
    const bool continuous = !tracking_ || std::abs(missing_us) < interval_us / 2;
    const bool after_gap = !continuous && missing_us > 0 && interval_us > 0;
    const auto valid = [](Validity validity) { return validity == Validity::valid; };
    return {.dt = tracking_ ? static_cast<double>(t_us - now_us_) * us : design_.settings.sample_period,
            .interval = after_gap ? static_cast<double>(interval_us) * us : 0,
            .error = {.pitch = angles.error_pitch_rad, .yaw = angles.error_yaw_rad},
            .antenna_increment = {.pitch = antenna.antenna_increment_pitch_rad,
                                  .yaw = antenna.antenna_increment_yaw_rad},
            .roll_increment = antenna.antenna_increment_roll_rad,
            .missile_acceleration = {.pitch = motion.missile_acceleration_z_mps2,
                                     .yaw = motion.missile_acceleration_y_mps2},
            .range = {range.range_m, motion.closing_speed_mps, valid(range.range_validity),
                      valid(motion.closing_speed_validity)},
            .error_valid = valid(angles.error_validity),
            .antenna_valid = valid(antenna.antenna_validity) && (continuous || after_gap),
            .acceleration_valid = valid(motion.acceleration_validity)};
  }

  static void observe(const los::UpdateResult& result, ConsistencyMonitor& monitor) {
    const los::Planes<double>&nu = result.innovation, &S = result.innovation_variance;
    monitor.observe(result.nis, std::array{nu.pitch / std::sqrt(S.pitch), nu.yaw / std::sqrt(S.yaw)});
  }

  // Answers an unused group with the current estimate.
  Health refuse(std::int64_t t_us, Context& context, los::Outcome why = los::Outcome::bad_step) {
    los::UpdateResult nothing;
    nothing.outcome = why;
    nothing.blind = last_.blind;
    nothing.sigma = last_.sigma;
    nothing.lag = last_.lag;
    nothing.used = last_.used;
    answer(t_us, nothing, context);
    return Health::good;
  }

  void answer(std::int64_t t_us, const los::UpdateResult& result, Context& context) const {
    Answers& answers = context.answers;
    const los::Estimate best = los::estimate(state_);
    answers.send(LosRateEstimate{.los_rate_pitch_radps = best.rate.pitch,
                                 .los_rate_yaw_radps = best.rate.yaw,
                                 .cause_counter = group_.counter(),
                                 .outcome = on_bus(result.outcome),
                                 .fault = on_bus(result.fault),
                                 .blind = static_cast<std::uint8_t>(result.blind)});
    const los::Planes<los::Sigma> sigma = los::reported_sigma(result, design_);
    answers.send(LosRateSigma{.los_rate_sigma_pitch_radps = sigma.pitch.rate,
                              .los_rate_sigma_yaw_radps = sigma.yaw.rate,
                              .target_acceleration_sigma_y_mps2 = sigma.yaw.acceleration,
                              .target_acceleration_sigma_z_mps2 = sigma.pitch.acceleration,
                              .nis = result.nis,
                              .degraded = static_cast<std::uint8_t>(context.consistency.degraded())});
    answers.send(LosRateTarget{.target_acceleration_y_mps2 = best.acceleration.yaw,
                               .target_acceleration_z_mps2 = best.acceleration.pitch,
                               .cause_time_us = wrap_us(t_us)});
  }

  los::Design design_;
  los::State state_;
  los::UpdateResult last_;
  SampleGroup<SeekerAntenna, SeekerAngles, SeekerMotion, SeekerRange> group_;
  std::int64_t now_us_ = 0;  // time of validity of the last step, or of the initial state
  bool tracking_ = false;    // at least one step since acquire()
};

}  // namespace

std::unique_ptr<Adapter> make_los_rate_adapter() { return std::make_unique<LosRateAdapter>(); }

}  // namespace canhil::target
