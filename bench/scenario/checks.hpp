// [[check]]: what a run is judged by. A new kind is a struct here, its reader in checks.cpp, and its judge in
// bench/checks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/scenario/contract.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {

class Section;

/// The estimators of attitude and velocity.
enum class Aligner : std::uint8_t { transfer_alignment, inflight_alignment };
enum class AttitudeAxis : std::uint8_t { roll, pitch, heading };
enum class VelocityAxis : std::uint8_t { north, east, down, norm };
enum class PositionAxis : std::uint8_t { north, east, down, horizontal, norm };
enum class Statistic : std::uint8_t { attitude_nees, nis, heading_nees, los_nis, wind_nis, wind_nees };
enum class WindAxis : std::uint8_t { along_track, cross_track, down, norm };
enum class WindStatistic : std::uint8_t { mean, max };
enum class LosPlane : std::uint8_t { pitch, yaw, both };
enum class LosStatistic : std::uint8_t { rms, max };

/// The unit in which a bar was given, and is reported in.
struct AngleUnit {
  std::string_view name;
  double factor;  ///< to rad
};
inline constexpr AngleUnit mrad{"mrad", world::units::mrad};
inline constexpr AngleUnit degrees{"deg", world::units::deg};

/// Part of a run, ends included, by the time of validity an answer names as its cause.
struct Window {
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
};

/// |estimated - true| Euler angle stays below a bar throughout the window.
struct AttitudeError {
  static constexpr std::string_view kind = "attitude_error";
  Aligner of = Aligner::transfer_alignment;
  AttitudeAxis axis = AttitudeAxis::heading;
  Window window;
  double below = 0;  ///< [rad]
  AngleUnit unit = mrad;
};

/// The error enters a band before a time, and stays there to the end of the run.
struct Convergence {
  static constexpr std::string_view kind = "convergence";
  Aligner of = Aligner::transfer_alignment;
  AttitudeAxis axis = AttitudeAxis::heading;
  double within = 0;  ///< [rad]
  std::int64_t before_us = 0;
  AngleUnit unit = mrad;
};

/// |estimated - true| velocity stays below a bar throughout the window.
struct VelocityError {
  static constexpr std::string_view kind = "velocity_error";
  Aligner of = Aligner::transfer_alignment;
  VelocityAxis axis = VelocityAxis::norm;
  Window window;
  double below = 0;  ///< [m/s]
};

/// |estimated - true| position stays below a bar at all fixes of the window that were used or gated.
struct PositionError {
  static constexpr std::string_view kind = "position_error";
  PositionAxis axis = PositionAxis::norm;
  Window window;
  double below = 0;  ///< [m]
};

/// What became of the fixes of the window, as the target says. Absent: not judged.
struct Fixes {
  static constexpr std::string_view kind = "fixes";
  struct Count {
    std::string outcome;  ///< a name of the DBC's value table FixOutcome
    std::optional<std::int64_t> at_least, at_most;
  };
  Window window;
  std::vector<Count> counts;
  std::optional<std::int64_t> repairs_at_most;        ///< of the covariance, since the start
  std::optional<std::int64_t> handed_over_before_us;  ///< the heading is resolved
};

/// |estimated - true| LOS rate stays below a bar, or its RMS does, over a window of the time to go.
struct LosRateError {
  static constexpr std::string_view kind = "los_rate_error";
  LosPlane plane = LosPlane::both;
  LosStatistic statistic = LosStatistic::rms;
  double least_to_go = 0, most_to_go = 0;  ///< range over closing speed [s]
  double below = 0;                        ///< [rad/s]
};

/// The closest approach of missile and target stays below a bar.
struct MissDistance {
  static constexpr std::string_view kind = "miss_distance";
  double below = 0;  ///< [m]
};

/// How many navigation answers, or LOS rates, of the window said that they bridged an input that was lost.
struct Coasting {
  static constexpr std::string_view kind = "coasting";
  Window window;
  std::optional<std::int64_t> at_least, at_most;
};

/// The mean or the largest |estimated - true| wind of the window stays below a bar.
struct WindError {
  static constexpr std::string_view kind = "wind_error";
  WindAxis axis = WindAxis::norm;
  WindStatistic statistic = WindStatistic::max;
  Window window;
  double below = 0;  ///< [m/s]
};

/// How many wind answers of the window had an outcome or a flag. Absent: not judged.
struct WindAnswers {
  static constexpr std::string_view kind = "wind_answers";
  struct Count {
    std::string name;  ///< of the DBC's value table WindOutcome, or of wind_flags
    bool is_flag = false;
    std::optional<std::int64_t> at_least, at_most;
  };
  Window window;
  std::vector<Count> counts;
};
inline constexpr std::array<std::string_view, 5> wind_flags{"outside", "fins_late", "fins_missing",
                                                            "fins_not_physical", "theta_capped"};

/// The mean of a normalised error squared over the window lies between two values.
struct MeanBetween {
  double low = 0;
  double high = 0;
};
/// Only for white statistics (NIS): the mean lies in the central chi-square interval that holds this
/// probability.
struct Probability {
  double value = 0;
};
struct Consistency {
  static constexpr std::string_view kind = "consistency";
  Aligner of = Aligner::transfer_alignment;  ///< of the statistics of an alignment
  Statistic statistic =
      Statistic::nis;  ///< of 3 degrees of freedom; heading_nees: of 1, los_nis: of 2, wind_nis: of 9
  Window window;
  std::variant<MeanBetween, Probability> bound;
};

/// Timing: the time between successive frames of a message stays within a fraction of its period.
struct OutputPeriod {
  static constexpr std::string_view kind = "output_period";
  std::string message;
  Window window;
  double within = 0;    ///< fraction of the period: 0.1 is 10 %
  double quantile = 1;  ///< 1: every interval; 0.99: all but one in a hundred
};

/// Timing: from the last frame of the stimulus to the message that answers it.
struct Latency {
  static constexpr std::string_view kind = "latency";
  std::string message;
  Window window;
  std::int64_t below_us = 0;
  double quantile = 1;  ///< 1: every answer; 0.99: all but one in a hundred
};

/// The target's own counters at the end (TargetCounters). Absent: not judged.
struct Counters {
  static constexpr std::string_view kind = "counters";
  std::optional<std::int64_t> frames_lost_at_most;
  std::optional<std::int64_t> bad_crc_at_most;
  std::optional<std::int64_t> bad_group_at_most;
  std::optional<std::int64_t> late_at_most;
};

/// No gap between heartbeats longer than this, up to the end of the run.
struct Heartbeat {
  static constexpr std::string_view kind = "heartbeat";
  std::int64_t silent_at_most_us = 0;
};

/// The frames of everybody keep the bus busy for less than a share of each second, at a bit rate.
struct BusLoad {
  static constexpr std::string_view kind = "bus_load";
  std::int64_t bitrate = 0;       ///< [bit/s]
  std::int64_t data_bitrate = 0;  ///< of the data phase of FD frames [bit/s]; 0: as the other
  double below = 0;               ///< share: 0.5 is 50 %
};

/// No frame takes longer over the bus than its worst case by theory; needs a bus whose bit rate is known.
struct WireResponse {
  static constexpr std::string_view kind = "wire_response";
};

/// What went wrong on the bus itself. Absent: not judged; without such a check a bus-off or an outage fails
/// every run.
struct BusErrorLimits {
  static constexpr std::string_view kind = "bus_errors";
  std::int64_t bus_off_at_most = 0;
  std::int64_t down_at_most = 0;  ///< of the bench's interface
  std::optional<std::int64_t> passive_at_most;
  std::optional<std::int64_t> warning_at_most;
  std::optional<std::int64_t> error_frames_at_most;
  std::optional<std::int64_t> late_in_queue_at_most;  ///< frames of the bench
};

struct Check {
  std::string
      name;  ///< unique in the scenario; by default kind and what it looks at: "attitude_error heading"
  std::string requirement;  ///< id carried to the reports; may be empty
  int line = 0;             ///< of the scenario file
  std::variant<AttitudeError, Convergence, VelocityError, Consistency, OutputPeriod, Latency, Counters,
               Heartbeat, PositionError, Fixes, Coasting, LosRateError, MissDistance, WindError, WindAnswers,
               BusLoad, BusErrorLimits, WireResponse>
      rule;
};

std::string_view kind(const Check& check);
std::string_view name(Aligner aligner);
std::string_view name(AttitudeAxis axis);
std::string_view name(VelocityAxis axis);
std::string_view name(PositionAxis axis);
std::string_view name(Statistic statistic);
std::string_view name(WindAxis axis);
std::string_view name(WindStatistic statistic);
std::string_view name(LosPlane plane);

/// What a scenario has that answers can be held against, and whose they may be.
struct Truths {
  bool navigation = true;
  bool engagement = false;
  bool glide = false;
  std::vector<Aligner> aligners{};
  std::vector<std::string> estimators{};  ///< that run
};

Check read_check(Section& section, std::int64_t duration_us, const Contract& contract, const Truths& truths);

}  // namespace canhil::scenario
