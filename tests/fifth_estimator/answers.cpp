#include "tests/fifth_estimator/answers.hpp"

#include "bench/estimators/answer_group.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;

struct HeightGroup : AnswerGroup<HeightEstimate, HeightSigma, HeightBias, HeightUpdate> {
  void add(std::int64_t cause_us, HeightAnswers& answers) const {
    const auto& estimate = get<HeightEstimate>();
    const auto& sigma = get<HeightSigma>();
    const auto& update = get<HeightUpdate>();
    answers.push_back({.cause_us = cause_us,
                       .height = estimate.height_m,
                       .height_sigma = sigma.height_sigma_m,
                       .velocity_down = estimate.velocity_down_mps,
                       .velocity_down_sigma = sigma.velocity_sigma_down_mps,
                       .nis = update.nis,
                       .used = update.used != 0});
  }
};

}  // namespace

std::unique_ptr<Reception> height_reception() {
  return std::make_unique<ReceptionOf<HeightAnswers, HeightGroup>>();
}

HeightError error_of(const HeightAnswer& answer, const world::FlightRecord& flight) {
  const world::Truth truth = flight.at(answer.cause_us);
  return {.height = answer.height - truth.position.height,
          .velocity_down = answer.velocity_down - truth.v_eb_n.z()};
}

}  // namespace canhil::estimators
