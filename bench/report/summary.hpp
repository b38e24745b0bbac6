// What a run measured, apart from its checks: the figures that every report shows.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/timing.hpp"
#include "bench/run/session.hpp"

namespace canhil::report {

/// Time at which the heading error enters a band for good.
struct BandEntry {
  double within_rad = 0;
  scenario::AngleUnit unit = scenario::mrad;  ///< in which people read it
  std::optional<double> t_s;                  ///< none: outside at the end
};

/// Latency of one message of the target.
struct MessageLatency {
  std::string message;
  checks::Distribution latency_s;
  checks::Distribution jitter_s;
  std::size_t unanswered = 0;
};

/// What became of the fixes of an alignment in flight, as the target says.
struct FixSummary {
  std::vector<std::pair<std::string, std::size_t>> outcomes;  ///< those that occurred
  std::uint32_t repairs = 0;                                  ///< of the covariance
  bool hands_over = false;  ///< the algorithm keeps the heading apart from the INS until it is resolved
  std::optional<double> resolved_s;  ///< when it was resolved and fed back to the INS; none: not by the end
  double heading_sigma_rad = 0;      ///< at the end
};

/// RMS of the error of the LOS rate, both planes, in a window of the time to go.
struct LosRms {
  double most_to_go_s = 0, least_to_go_s = 0;
  std::optional<double> rms_radps;  ///< none: no answers there
};

/// An engagement as it was flown.
struct EngagementSummary {
  std::optional<double> miss_m;  ///< none: the target was not passed
  double passage_s = 0;
  std::size_t late_commands = 0;
  std::vector<LosRms> rms;
  std::vector<std::pair<std::string, std::size_t>> outcomes;  ///< of the answers, those that occurred
};

/// A wind estimate as it was judged.
struct WindSummary {
  double from_s = 10;                                              ///< errors count from here to the end
  std::optional<double> along_mps, cross_mps, down_mps, norm_mps;  ///< mean |error|; none: no answers there
  double along_sigma_mps = 0;                                      ///< at the end, as the target tells it
  std::vector<std::pair<std::string, std::size_t>> outcomes;  ///< of the answers, and flags, that occurred
};

/// What an estimator of attitude and velocity made of the run.
struct AlignmentSummary {
  scenario::Aligner estimator{};
  std::vector<BandEntry> heading_entries;
  std::optional<world::Euler> final_error_rad;  ///< of the last navigation answer; none: there was none
  double final_velocity_error_mps = 0;
  std::optional<FixSummary> fixes;  ///< none: the target answered no fix
};

struct Summary {
  std::vector<AlignmentSummary> alignments;  ///< one for each that the scenario runs
  std::size_t navigation_answers = 0;
  std::size_t filter_answers = 0;
  std::optional<EngagementSummary> engagement;
  std::size_t los_answers = 0;
  std::optional<WindSummary> wind;
  std::size_t wind_answers = 0;
  std::vector<MessageLatency> latencies;  ///< of the closing message of each group
  checks::Distribution lateness_s;        ///< of the bench's own transmissions
  std::string_view clock;                 ///< by which the run went
  std::string stamp_source;               ///< what the latencies were measured with
};

Summary summarise(const scenario::Scenario& scenario, const run::Run& run);

/// In which people read the angles of an alignment: a fine one, or one that starts from anywhere and has
/// fixes.
scenario::AngleUnit angle_unit(scenario::Aligner aligner);

/// The message that closes each group of answers of the estimators in use.
std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario);

/// True of the messages that the estimators in use owe the bench: those of the groups that closing_answers()
/// closes.
bool is_due(const scenario::Scenario& scenario, const MessageInfo& message);

/// The bit rates that reports tell the bus load at: that of the bus, or, where it has none, 500 kbit/s and
/// 1 Mbit/s, on CAN FD with a data phase of 2 and 5 Mbit/s.
std::vector<wire::BitRates> load_rates(const run::Run& run);

/// The periods that the scenario sets in place of the DBC's cycle times: "SlaveImu every 5 ms (DBC: 10 ms)".
std::vector<std::string> period_overrides(const scenario::Scenario& scenario);

}  // namespace canhil::report
