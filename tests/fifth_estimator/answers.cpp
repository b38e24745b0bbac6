#include "tests/fifth_estimator/answers.hpp"

#include "bench/estimators/answer_group.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;

using HeightGroup = AnswerGroup<HeightEstimate, HeightSigma, HeightBias, HeightUpdate>;

class HeightReception final : public Reception {
 public:
  [[nodiscard]] bool takes(std::size_t message) const override { return HeightGroup::has(message); }
  std::optional<Whole> take(const Frame& frame, std::size_t /*message*/, std::int64_t now_us,
                            checks::Observations& seen) override {
    if (!group_.put(frame)) return std::nullopt;
    const auto& estimate = group_.get<HeightEstimate>();
    const auto& sigma = group_.get<HeightSigma>();
    const auto& update = group_.get<HeightUpdate>();
    const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us);
    seen.of<HeightAnswers>().push_back({.cause_us = cause_us,
                                        .height = estimate.height_m,
                                        .height_sigma = sigma.height_sigma_m,
                                        .velocity_down = estimate.velocity_down_mps,
                                        .velocity_down_sigma = sigma.velocity_sigma_down_mps,
                                        .nis = update.nis,
                                        .used = update.used != 0});
    return Whole{.messages = HeightGroup::messages,
                 .cause_us = cause_us,
                 .cause_group = HeightUpdate::info.answers.front()};
  }

 private:
  HeightGroup group_;
};

}  // namespace

std::unique_ptr<Reception> height_reception() { return std::make_unique<HeightReception>(); }

HeightError error_of(const HeightAnswer& answer, const world::FlightRecord& flight) {
  const world::Truth truth = flight.at(answer.cause_us);
  return {.height = answer.height - truth.position.height,
          .velocity_down = answer.velocity_down - truth.v_eb_n.z()};
}

}  // namespace canhil::estimators
