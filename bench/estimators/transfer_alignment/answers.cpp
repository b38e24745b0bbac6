#include "bench/estimators/transfer_alignment/answers.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;
using world::Vector3;
using world::units::degph;
using world::units::ug;

struct FilterGroup
    : AnswerGroup<AlignInnovation, AlignAttitudeSigma, AlignAttitudeCorrelation, AlignVelocitySigma,
                  AlignGyroBias, AlignGyroBiasSigma, AlignAccelBias, AlignAccelBiasSigma, AlignUpdate> {
  void add(std::int64_t cause_us, TransferAnswers& answers) const {
    const auto& innovation = get<AlignInnovation>();
    const auto& sigma = get<AlignAttitudeSigma>();
    const auto& correlation = get<AlignAttitudeCorrelation>();
    const auto& velocity = get<AlignVelocitySigma>();
    const auto& gyro = get<AlignGyroBias>();
    const auto& accel = get<AlignAccelBias>();
    answers.filter.push_back(
        {.cause_us = cause_us,
         .navigation_us = latest_cause_us(answers.navigation),
         .nis = get<AlignUpdate>().nis,
         .innovation = {innovation.innovation_north_mps, innovation.innovation_east_mps,
                        innovation.innovation_down_mps},
         .attitude_sigma = {sigma.attitude_sigma_north_rad, sigma.attitude_sigma_east_rad,
                            sigma.attitude_sigma_down_rad},
         .attitude_correlation = {correlation.attitude_correlation_ne, correlation.attitude_correlation_nd,
                                  correlation.attitude_correlation_ed},
         .velocity_sigma = {velocity.velocity_sigma_north_mps, velocity.velocity_sigma_east_mps,
                            velocity.velocity_sigma_down_mps},
         .gyro_bias = Vector3(gyro.gyro_bias_x_degph, gyro.gyro_bias_y_degph, gyro.gyro_bias_z_degph) * degph,
         .accel_bias = Vector3(accel.accel_bias_x_ug, accel.accel_bias_y_ug, accel.accel_bias_z_ug) * ug,
         .degraded = velocity.degraded != 0});
  }
};
using Navigation = NavigationGroup<AlignAttitude, AlignVelocityNE, AlignVelocityD>;

}  // namespace

std::unique_ptr<Reception> transfer_reception() {
  return std::make_unique<ReceptionOf<TransferAnswers, Navigation, FilterGroup>>();
}

Spool<quantities::TrackPoint> nees_of(const TransferAnswers& answers, const world::FlightRecord& truth) {
  Spool<quantities::TrackPoint> series;
  for (const FilterAnswer& answer : answers.filter) {
    const auto after = answers.navigation.first_after(answer.cause_us, answer.navigation_us, truth);
    if (!after) continue;
    series.push_back(
        {answer.cause_us, nees(after->misalignment, answer.attitude_sigma, answer.attitude_correlation)});
  }
  return series;
}

}  // namespace canhil::estimators
