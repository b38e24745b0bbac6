// The adapter of wind estimation. Input: the groups Fins and GliderNav; output: the group Wind.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/group_intake.hpp"
#include "target/device/tuned_adapter.hpp"
#include "target/device/wind_parameters.hpp"
#include "target/estimators/wind/bank.hpp"

namespace canhil::target {
namespace {

using namespace messages;

constexpr double deg = std::numbers::pi / 180;

constexpr std::int64_t lead_limit_us = 200'000;     // a sample further ahead of the last Sync is rejected
constexpr std::int64_t silence_limit_us = 500'000;  // a longer silence of navigation is an error
// During this time after a start, the adapter reports the sigmas as not valid. The sigmas assume that
// coefficient errors are redrawn every 50 ms and average out over many intervals of 50 ms. The gains after a
// start are too high for this averaging: of 200 flights with coefficient errors of 20 %, 15 had errors of
// more than 5 sigma within 0.3 s.
constexpr std::int64_t settling_us = 1'000'000;
// For this time after the model was unreliable (without deflections of the fins, or outside its range), the
// wind may still be wrong.
constexpr std::int64_t recovery_us = 5'000'000;
// Physical limits. They are below the limits of the bus, so that the bus can also carry invalid values.
constexpr double ground_speed_most = 600;
constexpr double rate_most = 300 * deg;

static_assert(static_cast<int>(WindOutcome::waiting) == static_cast<int>(wind::Outcome::waiting) &&
              static_cast<int>(WindOutcome::non_finite) == static_cast<int>(wind::Outcome::non_finite) &&
              static_cast<int>(WindFault::none) == static_cast<int>(wind::Fault::none) &&
              static_cast<int>(WindFault::jump) == static_cast<int>(wind::Fault::jump));

std::optional<wind::Algorithm> algorithm_of(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::ekf:
      return wind::Algorithm::ekf;
    case Algorithm::h_infinity:
      return wind::Algorithm::h_infinity;
    case Algorithm::adaptive_q:
      return wind::Algorithm::adaptive_q;
    default:
      return std::nullopt;
  }
}

// An angle [rad]. A value beyond half a turn becomes NaN, because an encoder that does not check limits turns
// a NaN into a value beyond half a turn.
double angle(double value_deg) {
  return std::abs(value_deg) <= 180.5 ? value_deg * deg : std::numeric_limits<double>::quiet_NaN();
}

Eigen::Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

class WindAdapter final : public TunedAdapter<WindTuning> {
 public:
  WindAdapter() : TunedAdapter(wind_parameters) {}

  [[nodiscard]] Estimator estimator() const override { return Estimator::wind; }

  bool reset(Algorithm algorithm) override {
    const auto chosen = algorithm_of(algorithm);
    if (!chosen) return false;
    tuning_ = {};
    tuning_.filter.algorithm = *chosen;
    tuning_.filter.sample_period = 1e-6 * static_cast<double>(GliderNavVelocityD::info.cycle_time_us);
    tuning_.filter.ground_speed_most = ground_speed_most;
    tuning_.filter.rate_most = rate_most;
    reset_parameters();
    design_ = wind::make_bank(tuning_.filter);
    return true;
  }

  ParameterStatus set(Parameter parameter, double value, bool running) override {
    const ParameterStatus status = TunedAdapter::set(parameter, value, running);
    design_ = wind::make_bank(tuning_.filter);
    return status;
  }
  // If the air velocity at release is not given, the wind is unknown, and the first usable sample starts the
  // filter.
  void start(const InitialState& initial) override {
    wind::Settings& filter = tuning_.filter;
    filter.velocity_sigma_0 = std::max(initial.velocity_sigma, 1e-3);
    filter.attitude_sigma_0 = std::max({initial.tilt_sigma, initial.heading_sigma, 1e-3 * deg});
    design_ = wind::make_bank(filter);
    bank_ = initial.air ? wind::initial({.t_us = initial.t_us,
                                         .air_velocity = vector(initial.air->velocity),
                                         .v_eb_n = {initial.v_north, initial.v_east, initial.v_down},
                                         .omega = vector(initial.air->rate),
                                         .attitude = {initial.roll, initial.pitch, initial.heading},
                                         .altitude = initial.height},
                                        design_)
                        : wind::initial(design_);
    fins_ = {};
    group_.discard();
    start_us_ = newest_us_ = answered_us_ = initial.t_us;
    settled_us_ = start_us_ + settling_us;
    answered_us_ -= tuning_.output_interval_us;
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    switch (frame.id) {
      case FinDeflections::info.id:
        on_fins(from_frame<FinDeflections>(frame), context);
        break;
      case GliderNavVelocityNE::info.id:
        put<GliderNavVelocityNE>(frame, counter, context);
        break;
      case GliderNavAttitude::info.id:
        put<GliderNavAttitude>(frame, counter, context);
        break;
      case GliderNavRates::info.id:
        put<GliderNavRates>(frame, counter, context);
        break;
      case GliderNavVelocityD::info.id:
        put<GliderNavVelocityD>(frame, counter, context);
        break;
      default:
        break;
    }
    return Health::good;  // not a fault: the filter restarts by itself
  }

  Health tick(Context context) override {
    context.errors.input_silent = context.now_us - newest_us_ > silence_limit_us;
    return Health::good;
  }

 private:
  template <class Message>
  void put(const Frame& frame, std::uint8_t counter, Context& context) {
    if (completes<Message>(group_, frame, counter, context)) on_navigation(context);
  }

  // The latest plausible time of validity of a received sample: lead_limit_us after the last Sync or after
  // the start, whichever is later.
  [[nodiscard]] std::int64_t latest_us(const Context& context) const {
    return std::max(context.now_us, start_us_) + lead_limit_us;
  }

  void on_fins(const FinDeflections& fins, Context& context) {
    const std::int64_t t_us = unwrap_short_us(std::llround(fins.time_of_validity_us), latest_us(context));
    const wind::Deflection deflection{fins.elevator_deg * deg, fins.aileron_deg * deg, fins.rudder_deg * deg};
    switch (fins_.push(t_us, deflection, design_.of[0].airframe.deflection_most)) {
      case wind::FinOutcome::kept:
        break;
      case wind::FinOutcome::out_of_order:
        ++context.losses.late;
        break;
      case wind::FinOutcome::not_physical:
        drop_group(context);
        break;
    }
  }

  // Answers one group per output interval. In addition, answers every complete group that did not update the
  // filter, and every group that updated the filter while a quantity was outside the range of the model, or
  // while fin deflections were late or refused.
  void on_navigation(Context& context) {
    const auto& horizontal = group_.get<GliderNavVelocityNE>();
    const auto& attitude = group_.get<GliderNavAttitude>();
    const auto& rates = group_.get<GliderNavRates>();
    const auto& vertical = group_.get<GliderNavVelocityD>();
    const std::int64_t t_us = unwrap_us(vertical.time_of_validity_us, context.now_us);
    if (t_us > latest_us(context)) {
      drop_group(context);
      return answer(t_us, WindOutcome::future, {}, context);
    }
    const wind::UpdateResult result = wind::step(
        bank_,
        {.t_us = t_us,
         .v_eb_n = {horizontal.velocity_north_mps, horizontal.velocity_east_mps, vertical.velocity_down_mps},
         .omega = Eigen::Vector3d(rates.rate_x_degps, rates.rate_y_degps, rates.rate_z_degps) * deg,
         .attitude = {angle(attitude.roll_deg), angle(attitude.pitch_deg), angle(attitude.heading_deg)},
         .altitude = horizontal.height_m,
         .valid = attitude.navigation_validity == Validity::valid},
        fins_, design_);
    count(result, context);
    if (result.outcome == wind::Outcome::started) settled_us_ = t_us + settling_us;
    if (result.flags.degraded()) settled_us_ = std::max(settled_us_, t_us + recovery_us);
    context.consistency.distrust(t_us < settled_us_);
    if (result.outcome == wind::Outcome::updated) observe(result, context.consistency);
    const std::int64_t interval_us = t_us - newest_us_;
    const bool is_due = t_us - answered_us_ >= tuning_.output_interval_us - interval_us / 2;
    newest_us_ = std::max(newest_us_, t_us);
    const bool reserved = result.outcome != wind::Outcome::updated || result.flags.outside.any() ||
                          result.flags.fins_late || result.flags.fins_not_physical;
    if (is_due) answered_us_ = t_us;
    if (is_due || reserved) answer(t_us, static_cast<WindOutcome>(result.outcome), result, context);
  }

  // The reported sigmas allow for lasting errors, so the sigmas of the innovation do too.
  static void observe(const wind::UpdateResult& result, ConsistencyMonitor& monitor) {
    const Eigen::Array<double, 9, 1> variance = 1 + result.lasting.array();
    const Eigen::Array<double, 9, 1> z = result.normalised.array() / variance.sqrt();
    const Eigen::Array<double, 9, 1> lasting = result.lasting.array() / variance;
    monitor.observe(z.square().sum(), {z.data(), 9}, {lasting.data(), 9});
  }

  static void count(const wind::UpdateResult& result, Context& context) {
    if (result.outcome == wind::Outcome::out_of_order) ++context.losses.late;
    if (result.outcome == wind::Outcome::non_finite) context.errors.numeric = true;
    switch (result.fault) {
      case wind::Fault::invalid:
      case wind::Fault::not_finite:
      case wind::Fault::not_physical:
      case wind::Fault::stale:
        return drop_group(context);
      case wind::Fault::none:
      case wind::Fault::pitch:  // a correct sample, but unusable with Euler angles
      case wind::Fault::jump:   // treated like a gated sample
        break;
    }
  }

  void answer(std::int64_t t_us, WindOutcome outcome, const wind::UpdateResult& result, Context& context) {
    Answers& answers = context.answers;
    constexpr int n = wind::wind_at, e = n + 1, d = n + 2;
    const auto bit = [](bool set) { return static_cast<std::uint8_t>(set); };
    const wind::Estimate best = wind::estimate(bank_.x);
    const wind::Uncertainty sigma = wind::uncertainty(bank_.x, bank_.P);
    const wind::RangeFlags& outside = result.flags.outside;
    const auto correlation = [&](int i, int j) {
      return bank_.P(i, j) / std::max(sigma.state(i) * sigma.state(j), 1e-12);
    };
    answers.send(WindVector{.wind_north_mps = best.wind.x(),
                            .wind_east_mps = best.wind.y(),
                            .wind_down_mps = best.wind.z(),
                            .started = bit(bank_.started)});
    answers.send(WindSpeed{.wind_speed_mps = best.wind_speed,
                           .wind_from_deg = best.wind_from / deg,
                           .outcome = outcome,
                           .fault = static_cast<WindFault>(result.fault),
                           .outside_alpha = bit(outside.alpha),
                           .outside_beta = bit(outside.beta),
                           .outside_speed = bit(outside.speed),
                           .outside_mach = bit(outside.mach),
                           .outside_altitude = bit(outside.altitude),
                           .outside_pitch = bit(outside.pitch),
                           .fins_late = bit(result.flags.fins_late),
                           .fins_missing = bit(result.flags.fins_missing),
                           .fins_not_physical = bit(result.flags.fins_not_physical),
                           .theta_capped = bit(result.flags.theta_capped),
                           .degraded = bit(context.consistency.degraded())});
    answers.send(WindSigma{.wind_sigma_north_mps = sigma.state(n),
                           .wind_sigma_east_mps = sigma.state(e),
                           .wind_sigma_down_mps = sigma.state(d)});
    answers.send(WindCorrelation{.wind_correlation_ne = correlation(n, e),
                                 .wind_correlation_nd = correlation(n, d),
                                 .wind_correlation_ed = correlation(e, d)});
    answers.send(WindTrackSigma{.along_track_sigma_mps = sigma.along_track,
                                .cross_track_sigma_mps = sigma.cross_track,
                                .wind_speed_sigma_mps = sigma.wind_speed,
                                .wind_from_sigma_deg = sigma.wind_from / deg});
    answers.send(WindAirVelocity{.air_velocity_x_mps = best.air_velocity.x(),
                                 .air_velocity_y_mps = best.air_velocity.y(),
                                 .air_velocity_z_mps = best.air_velocity.z()});
    answers.send(WindAttitude{.roll_deg = best.attitude.x() / deg,
                              .pitch_deg = best.attitude.y() / deg,
                              .heading_deg = best.attitude.z() / deg});
    answers.send(WindInnovation{.innovation_north_mps = result.innovation(0),
                                .innovation_east_mps = result.innovation(1),
                                .innovation_down_mps = result.innovation(2)});
    answers.send(
        WindUpdate{.cause_time_us = wrap_us(t_us), .cause_counter = group_.counter(), .nis = result.nis});
  }

  wind::BankDesign design_ = wind::make_bank({});
  wind::Bank bank_;
  wind::FinHistory fins_;
  SampleGroup<GliderNavVelocityNE, GliderNavAttitude, GliderNavRates, GliderNavVelocityD> group_;
  std::int64_t start_us_ = 0;
  std::int64_t settled_us_ = 0;   // the sigmas are not reliable before this time
  std::int64_t newest_us_ = 0;    // the newest time of validity of navigation
  std::int64_t answered_us_ = 0;  // the time of validity of the last answer
};

}  // namespace

std::unique_ptr<Adapter> make_wind_adapter() { return std::make_unique<WindAdapter>(); }

}  // namespace canhil::target
