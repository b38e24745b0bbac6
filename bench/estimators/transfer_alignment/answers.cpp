#include "bench/estimators/transfer_alignment/answers.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;
using world::Vector3;
using world::units::degph;
using world::units::ug;

using FilterGroup =
    AnswerGroup<AlignInnovation, AlignAttitudeSigma, AlignAttitudeCorrelation, AlignVelocitySigma,
                AlignGyroBias, AlignGyroBiasSigma, AlignAccelBias, AlignAccelBiasSigma, AlignUpdate>;
using Navigation = NavigationGroup<AlignAttitude, AlignVelocityNE, AlignVelocityD>;

Whole add(const FilterGroup& filter, std::int64_t now_us, TransferAnswers& answers) {
  const auto& innovation = filter.get<AlignInnovation>();
  const auto& sigma = filter.get<AlignAttitudeSigma>();
  const auto& correlation = filter.get<AlignAttitudeCorrelation>();
  const auto& velocity = filter.get<AlignVelocitySigma>();
  const auto& gyro = filter.get<AlignGyroBias>();
  const auto& accel = filter.get<AlignAccelBias>();
  const auto& update = filter.get<AlignUpdate>();
  const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us);
  answers.filter.push_back(
      {.cause_us = cause_us,
       .navigation_us = answers.navigation.empty() ? -1 : answers.navigation.back().cause_us,
       .nis = update.nis,
       .innovation = {innovation.innovation_north_mps, innovation.innovation_east_mps,
                      innovation.innovation_down_mps},
       .attitude_sigma = {sigma.attitude_sigma_north_rad, sigma.attitude_sigma_east_rad,
                          sigma.attitude_sigma_down_rad},
       .attitude_correlation = {correlation.attitude_correlation_ne, correlation.attitude_correlation_nd,
                                correlation.attitude_correlation_ed},
       .velocity_sigma = {velocity.velocity_sigma_north_mps, velocity.velocity_sigma_east_mps,
                          velocity.velocity_sigma_down_mps},
       .gyro_bias = Vector3(gyro.gyro_bias_x_degph, gyro.gyro_bias_y_degph, gyro.gyro_bias_z_degph) * degph,
       .accel_bias = Vector3(accel.accel_bias_x_ug, accel.accel_bias_y_ug, accel.accel_bias_z_ug) * ug});
  return {.messages = FilterGroup::messages,
          .cause_us = cause_us,
          .cause_group = AlignUpdate::info.answers.front()};
}

class TransferReception final : public Reception {
 public:
  [[nodiscard]] bool takes(std::size_t message) const override {
    return Navigation::Group::has(message) || FilterGroup::has(message);
  }
  std::optional<Whole> take(const Frame& frame, std::size_t message, std::int64_t now_us,
                            checks::Observations& seen) override {
    if (Navigation::Group::has(message)) {
      if (!navigation_.put(frame)) return std::nullopt;
      return navigation_.add(now_us, seen.of<TransferAnswers>().navigation);
    }
    return filter_.put(frame) ? std::optional(add(filter_, now_us, seen.of<TransferAnswers>()))
                              : std::nullopt;
  }

 private:
  Navigation navigation_;
  FilterGroup filter_;
};

}  // namespace

std::unique_ptr<Reception> transfer_reception() { return std::make_unique<TransferReception>(); }

std::vector<Normalised> nees_of(const std::vector<FilterAnswer>& filter,
                                const std::vector<NavigationError>& errors) {
  std::vector<Normalised> series;
  for (const FilterAnswer& answer : filter) {
    const NavigationError* after = first_after(errors, answer.cause_us, answer.navigation_us);
    if (after == nullptr) continue;
    series.push_back(
        {answer.cause_us, nees(after->misalignment, answer.attitude_sigma, answer.attitude_correlation)});
  }
  return series;
}

}  // namespace canhil::estimators
