// What a run showed: the target's answers decoded from frames, and the stamps of everything that passed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/world/attitude.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

/// Group AlignNav: aligned attitude and velocity at the time of a slave IMU sample. rad, m/s, NED.
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

/// One arrival of a message of the target.
struct Arrival {
  std::int64_t t_ns = 0;       ///< stamp of the port
  std::int64_t cause_us = -1;  ///< time of validity of what it answers; -1: answers nothing
};

/// The last frame of a sample group that the bench sent.
struct Stimulus {
  std::int64_t valid_us = 0;
  std::int64_t t_ns = 0;  ///< transmit stamp: the port's echo where it gives one
};

/// Everything that the checks judge, apart from the truth.
struct Observations {
  std::vector<NavigationAnswer> navigation;
  std::vector<FilterAnswer> filter;

  std::array<std::vector<Arrival>, messages::all_messages.size()> arrivals;  ///< by place in all_messages
  std::vector<Stimulus> slave_imu;
  std::vector<Stimulus> master_ins;
  std::int64_t first_ns = 0;              ///< stamp of the bench's first transmission
  std::int64_t last_ns = 0;               ///< and of its last one
  std::vector<std::int64_t> lateness_ns;  ///< of every transmission of the bench against its deadline
  bool transmit_stamps_echoed = false;    ///< stamps of stimuli are the bus's, not the bench's

  std::optional<messages::TargetHeartbeat> heartbeat;  ///< the last one
  std::optional<messages::TargetCounters> counters;    ///< the last one
  std::uint32_t target_frames_lost = 0;                ///< by the E2E counters of the target's messages
  std::uint32_t target_bad_crc = 0;
  std::uint32_t receive_overflows = 0;  ///< frames that the bench's own port lost
  std::uint16_t queue_max_us = 0;       ///< largest of TargetTiming; saturates at 8191
  std::uint16_t compute_max_us = 0;
  bool target_timing_seen = false;
};

}  // namespace canhil::checks
