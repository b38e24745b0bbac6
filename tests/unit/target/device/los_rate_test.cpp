// The LOS rate through the device: for the frames of an engagement, the device sends the estimator's values.
#include <gmock/gmock.h>

#include <array>
#include <string>

#include "tests/unit/target/device/missile.hpp"

namespace canhil::target {
namespace {

using namespace messages;
namespace los = los_rate;

struct Form {
  Algorithm on_bus;
  los::Algorithm own;
};
constexpr std::array forms{Form{Algorithm::switched_table, los::Algorithm::switched_table},
                           Form{Algorithm::combined, los::Algorithm::combined},
                           Form{Algorithm::kalman, los::Algorithm::kalman},
                           Form{Algorithm::low_pass, los::Algorithm::low_pass}};

template <class Message>
Message as_received(const Message& message) {
  return from_frame<Message>(to_frame(message, 0));
}

// The output of the estimator for this sample, computed without a Device.
los::UpdateResult own_step(los::State& state, const SeekerSample& sample, const los::Design& design) {
  const auto antenna = as_received(sample.antenna);
  const auto angles = as_received(sample.angles);
  const auto motion = as_received(sample.motion);
  return los::step(state,
                   {.dt = 0.005,
                    .error = {.pitch = angles.error_pitch_rad, .yaw = angles.error_yaw_rad},
                    .antenna_increment = {.pitch = antenna.antenna_increment_pitch_rad,
                                          .yaw = antenna.antenna_increment_yaw_rad},
                    .roll_increment = antenna.antenna_increment_roll_rad,
                    .missile_acceleration = {.pitch = motion.missile_acceleration_z_mps2,
                                             .yaw = motion.missile_acceleration_y_mps2},
                    .range = {as_received(sample.range).range_m, motion.closing_speed_mps, true, true},
                    .error_valid = true,
                    .antenna_valid = true,
                    .acceleration_valid = true},
                   design);
}

// The value on the bus equals the estimator's value `own` within half an LSB, or the limit of the signal.
void expect_near(double on_bus, double own, double lsb, double limit, const char* what) {
  EXPECT_NEAR(on_bus, std::clamp(own, -limit, limit), lsb * 0.5000001) << what;
}

TEST(LosRate, TheFramesOfAnEngagementGiveTheEstimatorsOwnFigures) {
  for (const Form& form : forms) {
    SCOPED_TRACE(name_of(form.on_bus));
    los::Settings settings;
    settings.algorithm = form.own;
    const los::Design design = los::make_design(settings);
    Missile missile(form.on_bus);
    los::State state = los::initial();
    unsigned blind = 0;
    for (unsigned k = 0; !missile.over(); ++k) {
      const SeekerSample sample = missile.next();
      missile.sync(missile.t_us());
      missile.transmit(sample);
      const los::UpdateResult result = own_step(state, sample, design);
      const los::Estimate own = los::estimate(state);
      const auto estimate = missile.estimate();
      const auto sigma = missile.sigma();
      const auto target = *missile.last<LosRateTarget>();
      expect_near(estimate.los_rate_pitch_radps, own.rate.pitch, 1e-5, 5.24, "pitch rate");
      expect_near(estimate.los_rate_yaw_radps, own.rate.yaw, 1e-5, 5.24, "yaw rate");
      const los::Planes<los::Sigma> reported = los::reported_sigma(result, design);
      expect_near(sigma.los_rate_sigma_pitch_radps, reported.pitch.rate, 2e-5, 0.327, "pitch sigma");
      expect_near(sigma.los_rate_sigma_yaw_radps, reported.yaw.rate, 2e-5, 0.327, "yaw sigma");
      expect_near(sigma.target_acceleration_sigma_y_mps2, result.sigma.yaw.acceleration, 2.5, 157.5,
                  "sigma y");
      expect_near(sigma.target_acceleration_sigma_z_mps2, result.sigma.pitch.acceleration, 2.5, 157.5,
                  "sigma z");
      expect_near(sigma.nis, result.nis, 0.1, 204.7, "nis");
      expect_near(target.target_acceleration_y_mps2, own.acceleration.yaw, 0.5, 255, "target y");
      expect_near(target.target_acceleration_z_mps2, own.acceleration.pitch, 0.5, 255, "target z");
      ASSERT_EQ(static_cast<int>(estimate.outcome), static_cast<int>(result.outcome));
      ASSERT_EQ(estimate.fault, LosRateFault::none);
      ASSERT_EQ(estimate.blind != 0, result.blind);
      ASSERT_EQ(estimate.cause_counter, k % 15);
      ASSERT_EQ(target.cause_time_us, missile.t_us());
      ASSERT_FALSE(testing::Test::HasFailure()) << missile.truth().time_to_go << " s to go";
      blind += estimate.blind;
    }
    EXPECT_GT(blind, 5U);
    EXPECT_TRUE(missile.device().running());
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_input_lost, 0);
  }
}

// Signs and planes: the estimate tracks the truth in both planes under roll and manoeuvre.
TEST(LosRate, TheEstimateIsTheTruthOfANoiseFreeEngagement) {
  for (const Algorithm algorithm : {Algorithm::switched_table, Algorithm::combined, Algorithm::kalman}) {
    SCOPED_TRACE(name_of(algorithm));
    Missile missile(algorithm);
    missile.fly_until(4);
    while (missile.truth().time_to_go > 1.01) {
      missile.fly();
      ASSERT_LT(missile.rate_error(), 2e-4) << missile.truth().time_to_go;
    }
    missile.fly_until(0.3);
    EXPECT_LT(missile.rate_error(), 5e-3) << "0.7 s after the target has turned";
    const auto target = *missile.last<LosRateTarget>();
    EXPECT_NEAR(target.target_acceleration_y_mps2, missile.truth().target.real(), 5);
    EXPECT_NEAR(target.target_acceleration_z_mps2, -missile.truth().target.imag(), 5);
  }
}

// The noise of the error angles is 15 times the configured noise. The answers and the heartbeat report
// `degraded` until the noise returns to the configured level.
TEST(LosRate, SaysThatItIsDegradedWhileItsInnovationsAreBeyondItsCovariance) {
  Missile missile;
  missile.fly_until(3);
  EXPECT_EQ(missile.sigma().degraded, 0);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->degraded, 0);
  double sign = 1;
  const auto fly = [&](double error_rad, int samples) {
    for (int i = 0; i < samples; ++i, sign = -sign)
      missile.fly([&](SeekerSample& sample) { sample.angles.error_pitch_rad += sign * error_rad; });
  };
  fly(0.015, 40);
  EXPECT_EQ(missile.sigma().degraded, 1);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->degraded, 1);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->state, TargetState::running);
  fly(0, 150);
  EXPECT_EQ(missile.sigma().degraded, 0);
  EXPECT_EQ(missile.last<TargetHeartbeat>()->degraded, 0);
}

TEST(LosRate, AnswersInTheCallThatTookTheLastFrameOfTheGroup) {
  Missile missile;
  missile.fly();
  missile.forget();
  const SeekerSample sample = missile.next();
  missile.send(sample.antenna);
  missile.send(sample.angles);
  missile.send(sample.motion);
  EXPECT_TRUE(missile.answers().empty());
  missile.send(sample.range);
  ASSERT_EQ(missile.answers().size(), 3U);
  EXPECT_EQ(missile.answers()[0].id, LosRateEstimate::info.id);
  EXPECT_EQ(missile.answers()[1].id, LosRateSigma::info.id);
  EXPECT_EQ(missile.answers()[2].id, LosRateTarget::info.id);
}

TEST(LosRate, NeedsNoNavigationState) {
  const auto flight = [](double latitude_deg, double speed) {
    Missile missile;
    missile.command(Command::reset, Estimator::los_rate, Algorithm::combined);
    missile.send(TargetInitLatitude{.latitude_deg = latitude_deg});
    missile.send(TargetInitLongitude{});
    missile.send(TargetInitVelocityNE{.velocity_north_mps = speed});
    missile.send(TargetInitAttitude{.heading_deg = speed});
    missile.send(TargetInitSigma{});
    missile.send(TargetInitVelocityD{.time_of_validity_us = 0});
    missile.command(Command::start);
    missile.forget();
    for (int k = 0; k < 100; ++k) missile.fly();
    return missile.answers();
  };
  EXPECT_EQ(flight(0, 0), flight(60, 100));
  EXPECT_EQ(flight(0, 0).size(), 312U) << "and 6 heartbeats with their counters";
}

TEST(LosRate, StartsWithTheFirstUsableSample) {
  Missile missile;
  missile.fly([](SeekerSample& s) { s.range.range_validity = Validity::invalid; });
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::waiting);
  EXPECT_EQ(missile.estimate().fault, LosRateFault::range_invalid);
  EXPECT_NEAR(missile.sigma().los_rate_sigma_pitch_radps, 0.05, 1e-5);
  missile.fly();
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::started);
  missile.fly();
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::start_up);
  missile.fly_until(2.9);
  EXPECT_EQ(missile.estimate().outcome, LosRateOutcome::updated);
}

TEST(LosRate, RefusesAlgorithmsOfOthers) {
  for (const Algorithm algorithm : {Algorithm::robust_h2, Algorithm::ekf, Algorithm::sin_cos}) {
    BenchSide bench;
    bench.command(Command::reset, Estimator::los_rate, algorithm);
    EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
  }
  BenchSide bench;
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::combined);
  EXPECT_EQ(bench.last<TargetHeartbeat>()->error_command, 1);
}

constexpr Parameter first_parameter = Parameter::jerk_density_m2ps5;
constexpr Parameter last_parameter = Parameter::missile_acceleration_sigma_mps2;

std::vector<Parameter> own_parameters() {
  std::vector<Parameter> own;
  for (const Parameter parameter : enumerators<Parameter>)
    if (parameter >= first_parameter && parameter <= last_parameter) own.push_back(parameter);
  return own;
}

// For every parameter, -1 and 1e30 are outside the range, and 1.5 times the default is inside the range (the
// test uses 0.01 if the default is 0).
TEST(LosRateParameters, AreReadBackRefusedOutsideTheirRangeAndWhileRunning) {
  ASSERT_EQ(own_parameters().size(), 25U);
  for (const Parameter parameter : own_parameters()) {
    SCOPED_TRACE(name_of(parameter));
    BenchSide bench;
    bench.command(Command::reset, Estimator::los_rate, Algorithm::combined);
    const auto answer = [&](float value) {
      bench.send(ParamSet{.parameter = parameter, .value = value});
      return *bench.last<ParamAck>();
    };
    const float standard = answer(-1).value;
    EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::out_of_range);
    EXPECT_EQ(answer(1e30F).status, ParameterStatus::out_of_range);
    const float changed = standard > 0 ? standard * 1.5F : 0.01F;
    EXPECT_EQ(answer(changed).status, ParameterStatus::accepted);
    EXPECT_EQ(bench.last<ParamAck>()->value, changed);
    EXPECT_EQ(answer(-1).value, changed) << "a refused value changes nothing";
    bench.initialise();
    bench.command(Command::start);
    EXPECT_EQ(answer(standard).status, ParameterStatus::wrong_state);
    EXPECT_EQ(bench.last<ParamAck>()->value, changed);
    bench.command(Command::reset, Estimator::los_rate, Algorithm::combined);
    EXPECT_EQ(answer(-1).value, standard) << "reset";
  }
}

TEST(LosRateParameters, OfOtherEstimatorsAreUnknown) {
  BenchSide bench;
  bench.command(Command::reset, Estimator::los_rate, Algorithm::combined);
  bench.send(ParamSet{.parameter = Parameter::h2_case, .value = 1});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::unknown);
  bench.command(Command::reset, Estimator::transfer_alignment, Algorithm::kalman);
  bench.send(ParamSet{.parameter = first_parameter, .value = 100});
  EXPECT_EQ(bench.last<ParamAck>()->status, ParameterStatus::unknown);
}

TEST(LosRateParameters, SettingsReachTheEstimator) {
  struct Answer {
    LosRateEstimate estimate;
    LosRateSigma sigma;
  };
  const auto at_two_seconds = [](const std::vector<ParamSet>& parameters,
                                 Algorithm algorithm = Algorithm::combined) {
    Missile missile(algorithm, parameters);
    missile.fly_until(2);
    return Answer{missile.estimate(), missile.sigma()};
  };
  const auto standard = at_two_seconds({});
  const auto noisy_yaw = at_two_seconds({{.parameter = Parameter::thermal_noise_yaw_radpm2, .value = 1e-9F}});
  EXPECT_EQ(noisy_yaw.sigma.los_rate_sigma_pitch_radps, standard.sigma.los_rate_sigma_pitch_radps);
  EXPECT_GT(noisy_yaw.sigma.los_rate_sigma_yaw_radps, 2 * standard.sigma.los_rate_sigma_yaw_radps);
  const auto noisy_pitch =
      at_two_seconds({{.parameter = Parameter::constant_noise_pitch_rad, .value = 0.01F}});
  EXPECT_GT(noisy_pitch.sigma.los_rate_sigma_pitch_radps, 2 * standard.sigma.los_rate_sigma_pitch_radps);
  const auto agile = at_two_seconds({{.parameter = Parameter::jerk_density_m2ps5, .value = 3000}});
  EXPECT_GT(agile.sigma.target_acceleration_sigma_y_mps2, standard.sigma.target_acceleration_sigma_y_mps2);
  const auto blind = at_two_seconds({{.parameter = Parameter::blind_range_m, .value = 2000}});
  EXPECT_EQ(blind.estimate.blind, 1);
  EXPECT_EQ(standard.estimate.blind, 0);
  const auto starting = at_two_seconds({{.parameter = Parameter::start_up_s, .value = 10}});
  EXPECT_EQ(starting.estimate.outcome, LosRateOutcome::start_up);
  const auto slow =
      at_two_seconds({{.parameter = Parameter::low_pass_bandwidth_radps, .value = 2}}, Algorithm::low_pass);
  EXPECT_GT(at_two_seconds({}, Algorithm::low_pass).sigma.los_rate_sigma_pitch_radps,
            2 * slow.sigma.los_rate_sigma_pitch_radps);
}

// With random combinations of range limits, all designs and gains stay finite.
TEST(LosRateParameters, TheEndsOfTheRangesKeepTheEstimatorWhole) {
  std::mt19937_64 engine(1);
  // The largest and the smallest value that is accepted, found by a rough scan.
  std::vector<std::array<float, 2>> ends;
  for (const Parameter parameter : own_parameters()) {
    BenchSide bench;
    bench.command(Command::reset, Estimator::los_rate, Algorithm::combined);
    std::vector<float> accepted;
    for (const float value :
         {0.0F, 1.001e-14F, 1e-10F, 0.99e-6F, 1.001e-6F, 1.001e-3F, 0.099F, 0.1001F, 0.501F, 0.599F,
          1.0F, 5.0F,       10.0F,  49.9F,    100.0F,    200.0F,    1e3F,   1e4F,    1e5F,   1e6F}) {
      bench.send(ParamSet{.parameter = parameter, .value = value});
      if (bench.last<ParamAck>()->status == ParameterStatus::accepted) accepted.push_back(value);
    }
    ASSERT_GE(accepted.size(), 2U) << name_of(parameter);
    ends.push_back({accepted.front(), accepted.back()});
  }
  for (int trial = 0; trial < 120; ++trial) {
    const Form& form = forms[static_cast<std::size_t>(trial) % forms.size()];
    std::vector<ParamSet> parameters;
    for (std::size_t i = 0; i < ends.size(); ++i)
      if (engine() % 3 != 0)
        parameters.push_back({.parameter = own_parameters()[i], .value = ends[i][engine() % 2]});
    Missile missile(form.on_bus, parameters);
    for (int k = 0; !missile.over(); ++k) {
      if (k % 50 == 49) {
        missile.fly_unheard();
      } else {
        missile.fly();
      }
    }
    EXPECT_TRUE(missile.device().running()) << "trial " << trial;
    EXPECT_EQ(missile.last<TargetHeartbeat>()->error_numeric, 0);
    EXPECT_GT(missile.all<LosRateEstimate>().size(), 1000U);
  }
}

}  // namespace
}  // namespace canhil::target
