// What a run showed: the target's answers decoded from frames, and the stamps of everything that passed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/bus.hpp"
#include "bench/checks/host.hpp"
#include "bench/checks/timing_record.hpp"
#include "bench/world/earth.hpp"
#include "bench/world/engagement/plan.hpp"
#include "dbc/wire/bit_length.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// Group AlignNav or FixNav: aligned attitude and velocity at the time of a slave IMU sample. rad, m/s, NED.
struct NavigationAnswer {
  std::int64_t cause_us = 0;
  world::Euler angles;
  world::Vector3 v_eb_n = world::Vector3::Zero();
  bool coasting = false;
};

/// Group AlignFilter: the filter after the velocity update at the time of a master INS sample. SI, rad.
struct FilterAnswer {
  std::int64_t cause_us = 0;
  std::int64_t navigation_us = -1;  ///< cause of the last navigation answer before this one; -1: none
  double nis = 0;
  world::Vector3 innovation = world::Vector3::Zero();
  world::Vector3 attitude_sigma = world::Vector3::Zero();        ///< of the misalignment, NED
  world::Vector3 attitude_correlation = world::Vector3::Zero();  ///< north-east, north-down, east-down
  world::Vector3 velocity_sigma = world::Vector3::Zero();
  world::Vector3 gyro_bias = world::Vector3::Zero();   ///< body
  world::Vector3 accel_bias = world::Vector3::Zero();  ///< body
};

/// Group FixFilter: what became of a fix of the SSBL or the GPS, and the filter after it. SI, rad.
struct FixAnswer {
  std::int64_t cause_us = 0;
  std::int64_t navigation_us = -1;  ///< cause of the last navigation answer before this one; -1: none
  messages::FixSource source = messages::FixSource::ssbl;
  messages::FixOutcome outcome = messages::FixOutcome::accepted;
  double nis = 0;
  world::Vector3 innovation = world::Vector3::Zero();  ///< NED [m]
  world::Position position{};                          ///< at the time of validity of the fix
  double tilt_sigma_north = 0, tilt_sigma_east = 0;    ///< of the misalignment
  double heading_sigma = 0;
  world::Vector3 velocity_sigma = world::Vector3::Zero();  ///< NED
  world::Vector3 position_sigma = world::Vector3::Zero();  ///< NED [m]
  world::Vector3 gyro_bias = world::Vector3::Zero();       ///< body
  world::Vector3 accel_bias = world::Vector3::Zero();      ///< body
  world::Vector3 fix_bias = world::Vector3::Zero();        ///< NED [m]
  world::Vector3 fix_bias_sigma = world::Vector3::Zero();  ///< NED [m]
  bool handed_over = false;                                ///< the heading is resolved and fed back
  std::uint32_t repairs = 0;                               ///< of the covariance, since start
  std::uint32_t gated = 0;                                 ///< fixes rejected by the gate, since start
  std::uint32_t refused = 0;                               ///< fixes not used for another reason, since start
};

/// Group Wind: what the wind filter made of a GliderNav group. SI, rad, NED.
struct WindAnswer {
  std::int64_t cause_us = 0;
  bool started = false;  ///< the filter runs; else only the wind counts
  messages::WindOutcome outcome = messages::WindOutcome::waiting;
  messages::WindFault fault = messages::WindFault::none;
  bool outside = false;  ///< of the range of the model, in any of its variables
  bool fins_late = false;
  bool fins_missing = false;
  bool fins_not_physical = false;
  bool theta_capped = false;
  world::Vector3 wind_n = world::Vector3::Zero();
  world::Vector3 sigma = world::Vector3::Zero();
  world::Vector3 correlation = world::Vector3::Zero();  ///< north-east, north-down, east-down
  double along_track_sigma = 0;
  double cross_track_sigma = 0;
  world::Vector3 v_a = world::Vector3::Zero();  ///< air velocity, body
  double nis = 0;                               ///< of 9 degrees of freedom; 0: without an update
};

/// Group LosRate: the LOS rate at the time of a sample of the seeker, in its antenna's axes. SI, rad.
struct LosAnswer {
  std::int64_t cause_us = 0;
  messages::LosRateOutcome outcome = messages::LosRateOutcome::waiting;
  messages::LosRateFault fault = messages::LosRateFault::none;
  bool blind = false;  ///< too near: guidance is to hold its command
  world::Planes<double> rate{};
  world::Planes<double> rate_sigma{};
  world::Planes<double> target{};  ///< its acceleration along z (pitch) and y (yaw)
  world::Planes<double> target_sigma{};
  double nis = 0;  ///< of 2 degrees of freedom; 0 without an update
};

/// True if the filter was corrected by the sample, and by nothing it was told in place of one.
constexpr bool updated(messages::LosRateOutcome outcome) {
  return outcome == messages::LosRateOutcome::updated || outcome == messages::LosRateOutcome::start_up;
}
/// True if there is an estimate at all.
constexpr bool tells_rate(messages::LosRateOutcome outcome) {
  return updated(outcome) || outcome == messages::LosRateOutcome::coasting;
}

/// True if the filter made use of the fix.
constexpr bool used(messages::FixOutcome outcome) {
  return outcome == messages::FixOutcome::accepted || outcome == messages::FixOutcome::recovered;
}

/// The stimuli of a sample group, by time of validity.
struct StimulusCount {
  std::uint64_t count = 0;
  std::int64_t first_us = 0;
  std::int64_t last_us = 0;
  void add(std::int64_t valid_us) {
    first_us = count == 0 ? valid_us : std::min(first_us, valid_us);
    last_us = count == 0 ? valid_us : std::max(last_us, valid_us);
    ++count;
  }
};

/// A fix that the bench sent: it needs an answer.
struct SentFix {
  messages::FixSource source = messages::FixSource::ssbl;
  std::int64_t valid_us = 0;
};

/// Everything that the checks judge, apart from the truth.
struct Observations {
  std::vector<NavigationAnswer> navigation;      ///< of transfer alignment
  std::vector<NavigationAnswer> fix_navigation;  ///< of in-flight alignment
  std::vector<FilterAnswer> filter;
  std::vector<FixAnswer> fixes;
  std::vector<WindAnswer> wind;
  std::vector<LosAnswer> los;

  std::map<std::string_view, StimulusCount> stimuli;  ///< by sample group, those that are answered
  std::vector<SentFix> sent_fixes;
  std::array<std::uint64_t, messages::all_messages.size()> answers{};  ///< by place in all_messages
  std::int64_t first_ns = 0;            ///< stamp of the bench's first transmission
  std::int64_t last_ns = 0;             ///< and of its last one
  wire::BitRates bit_rates{};           ///< of the bus; nominal 0: not known, or it has none
  TimingRecord timing;                  ///< empty where no times are taken
  bool transmit_stamps_echoed = false;  ///< stamps of stimuli are the bus's, not the bench's

  std::optional<messages::TargetCounters> counters;  ///< the last one
  std::vector<wire::BitLength> length_by_second{};   ///< of all frames on the bus; see run::LoadMeter
  std::uint32_t target_frames_lost = 0;              ///< by the E2E counters of the target's messages
  std::uint32_t target_bad_crc = 0;
  std::uint32_t receive_overflows = 0;  ///< frames that the bench's own port lost
  std::uint16_t queue_max_us = 0;       ///< largest of TargetTiming; saturates at 8191
  std::uint16_t compute_max_us = 0;
  bool target_timing_seen = false;
  BusRecord bus;
  HostRecord host;
};

}  // namespace canhil::checks
