#include "bench/estimators/inflight_alignment/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "bench/checks/finding.hpp"
#include "bench/checks/silence.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;
using world::Vector3;
using world::units::deg;
using world::units::degph;
using world::units::ug;

std::string_view group_of(FixSource source) {
  if (source == FixSource::imu) return messages::SlaveImuStatus::info.sample_group;
  return source == FixSource::gps ? messages::GpsTime::info.sample_group
                                  : messages::SsblRelativeD::info.sample_group;
}

struct FixGroup : AnswerGroup<FixInnovation, FixPositionLatitude, FixPositionLongitude, FixAttitudeSigma,
                              FixVelocitySigma, FixPositionSigma, FixGyroBias, FixGyroBiasSigma, FixAccelBias,
                              FixAccelBiasSigma, FixBias, FixBiasSigma, FixStatus, FixUpdate> {
  /// The cause is a fix of one of two sources, or the IMU sample of a prediction. The message FixStatus names
  /// the source.
  [[nodiscard]] Whole whole(std::int64_t now_us) const {
    Whole answer = AnswerGroup::whole(now_us);
    answer.cause_group = group_of(get<FixStatus>().source);
    return answer;
  }
  void add(std::int64_t cause_us, InflightAnswers& answers) {
    const auto& innovation = get<FixInnovation>();
    const auto& latitude = get<FixPositionLatitude>();
    const auto& attitude = get<FixAttitudeSigma>();
    const auto& velocity = get<FixVelocitySigma>();
    const auto& position = get<FixPositionSigma>();
    const auto& gyro = get<FixGyroBias>();
    const auto& accel = get<FixAccelBias>();
    const auto& bias = get<FixBias>();
    const auto& bias_sigma = get<FixBiasSigma>();
    const auto& status = get<FixStatus>();
    answers.fixes.push_back(
        {.cause_us = cause_us,
         .navigation_us = latest_cause_us(answers.navigation),
         .source = status.source,
         .outcome = status.outcome,
         .nis = get<FixUpdate>().nis,
         .innovation = {innovation.innovation_north_m, innovation.innovation_east_m,
                        innovation.innovation_down_m},
         .position = {.latitude = latitude.latitude_deg * deg,
                      .longitude = get<FixPositionLongitude>().longitude_deg * deg,
                      .height = latitude.height_m},
         .attitude_sigma = {attitude.tilt_sigma_north_deg * deg, attitude.tilt_sigma_east_deg * deg,
                            attitude.heading_sigma_deg * deg},
         .velocity_sigma = {velocity.velocity_sigma_north_mps, velocity.velocity_sigma_east_mps,
                            velocity.velocity_sigma_down_mps},
         .position_sigma = {position.position_sigma_north_m, position.position_sigma_east_m,
                            position.position_sigma_down_m},
         .gyro_bias = Vector3(gyro.gyro_bias_x_degph, gyro.gyro_bias_y_degph, gyro.gyro_bias_z_degph) * degph,
         .accel_bias = Vector3(accel.accel_bias_x_ug, accel.accel_bias_y_ug, accel.accel_bias_z_ug) * ug,
         .fix_bias = {bias.fix_bias_north_m, bias.fix_bias_east_m, bias.fix_bias_down_m},
         .fix_bias_sigma = {bias_sigma.fix_bias_sigma_north_m, bias_sigma.fix_bias_sigma_east_m,
                            bias_sigma.fix_bias_sigma_down_m},
         .degraded = status.degraded != 0,
         .handed_over = status.handed_over != 0,
         .repairs = status.repairs,
         .repaired = std::exchange(repairs_, std::uint32_t{status.repairs}) != status.repairs,
         .gated = status.gated,
         .refused = status.refused});
  }

 private:
  std::uint32_t repairs_ = 0;  // as reported by the last answer
};
using Navigation = NavigationGroup<FixAttitude, FixVelocityNE, FixVelocityD>;

class InflightReception final : public ReceptionOf<InflightAnswers, Navigation, FixGroup> {
  void sent(std::string_view group, std::int64_t valid_us, checks::Observations& seen) override {
    for (const FixSource source : {FixSource::ssbl, FixSource::gps}) {
      if (group == group_of(source))
        seen.of<InflightAnswers>().sent.push_back({.source = source, .valid_us = valid_us});
    }
  }
};

}  // namespace

std::unique_ptr<Reception> inflight_reception() { return std::make_unique<InflightReception>(); }

std::string unanswered_fixes(const InflightAnswers& answers, const scenario::Window& window) {
  std::vector<std::pair<FixSource, std::int64_t>> answered;
  for (const FixAnswer& fix : answers.fixes) answered.emplace_back(fix.source, fix.cause_us);
  std::ranges::sort(answered);
  std::map<FixSource, int> in_a_row;
  for (const auto& [source, valid_us] : answers.sent) {
    if (!checks::within(window, valid_us)) continue;
    int& missing = in_a_row[source];
    missing = std::ranges::binary_search(answered, std::pair(source, valid_us)) ? 0 : missing + 1;
    if (missing > checks::tolerated_fixes)
      return fmt::format("no answers to {} before {:g} s", group_of(source),
                         static_cast<double>(valid_us) * 1e-6);
  }
  return "";
}

bool has_time_and_truth(const FixAnswer& answer, const world::FlightRecord& truth) {
  const bool considered = used(answer.outcome) || answer.outcome == messages::FixOutcome::gated ||
                          answer.outcome == messages::FixOutcome::predicted;
  return considered && answer.cause_us >= 0 && answer.cause_us <= truth.known_until_us();
}

Vector3 position_error(const FixAnswer& answer, const world::FlightRecord& truth) {
  return world::displacement_n(truth.at(answer.cause_us).position, answer.position);
}

}  // namespace canhil::estimators
