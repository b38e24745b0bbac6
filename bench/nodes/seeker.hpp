// The missile's seeker with the guidance computer that flies on what the target makes of its samples.
#pragma once

#include <deque>

#include "bench/nodes/increment_rounding.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/seeker.hpp"
#include "bench/world/engagement/seeker_errors.hpp"
#include "dbc/wire/sample_group.hpp"

namespace canhil::nodes {

/// Random numbers of one run.
struct SeekerStreams {
  world::Stream engagement;
  world::Stream errors;
  world::Stream faults;  ///< losses and jitter: they change no measurement
};

/// Sends the group Seeker until the closest approach and records what was flown; `record` must outlive the
/// node. With guidance on the target's answers, that to a sample sent at t takes effect at t + the guidance
/// delay, however early it was heard: with a delay of a Sync cycle every bus and clock gives the same flight.
class Seeker final : public Node {
 public:
  Seeker(const world::EngagementPlan& plan, const scenario::Seeker& config, const SeekerStreams& streams,
         std::int64_t end_us, world::EngagementRecord& record);

  [[nodiscard]] std::int64_t due_us() const override;
  void transmit(Transmission& out) override;
  [[nodiscard]] bool listens() const override { return guided_; }
  void hear(const Frame& frame) override;

 private:
  /// A sample whose answer may still come.
  struct Sent {
    std::int64_t valid_us = 0;
    std::int64_t sent_us = 0;
    world::Matrix3 C_na;
    double closing_speed = 0;  ///< as measured [m/s]
  };

  void send(Transmission& out, const world::SeekerMeasurement& measured);
  void advance();
  void steer();

  world::Engagement engagement_;
  world::ErroneousSeeker errors_;
  scenario::Seeker config_;
  world::Stream faults_;
  bool guided_;
  std::int64_t guidance_delay_us_;
  std::int64_t period_us_;
  std::int64_t end_us_;
  world::EngagementRecord& record_;
  std::int64_t valid_us_;
  std::int64_t due_us_ = 0;
  IncrementRounding rounding_;
  std::deque<Sent> sent_;
  SampleGroup<messages::LosRateEstimate, messages::LosRateSigma, messages::LosRateTarget> answer_;
};

}  // namespace canhil::nodes
