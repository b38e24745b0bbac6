// The contents that every report of a run has in addition to the results of the checks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/results.hpp"
#include "bench/drive/session.hpp"

namespace canhil::report {

/// The results of an estimator; the last line counts its answers by mark.
struct EstimatorResults {
  std::string_view estimator;
  std::vector<estimators::ResultLine> lines;
};

/// Whether a signal ended the run. Its answers are then not evaluated, because the command must end at once.
bool is_cut_off(const drive::Run& run);

/// The results of each estimator of the scenario; none of a run that was cut off.
std::vector<EstimatorResults> results(const scenario::Scenario& scenario, const drive::Run& run);

/// The tested program: the command that started it, or where it runs.
std::string target_program(const drive::Run& run);

/// The name of the clock of the run.
std::string_view clock_name(const drive::Run& run);

/// The source of the time stamps of latencies.
std::string_view stamp_source(const drive::Run& run);

/// The last message of each answer group of the running estimators.
std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario);

/// Whether the running estimators must send a message.
bool is_due(const scenario::Scenario& scenario, const MessageInfo& message);

/// The bit rates at which reports show the bus load: the bit rate of the bus. If the bus has no bit rate: 500
/// kbit/s and 1 Mbit/s; on CAN FD, the data phase then has 2 Mbit/s and 5 Mbit/s, respectively.
std::vector<wire::BitRates> load_rates(wire::BitRates known, BusFormat format);
std::vector<wire::BitRates> load_rates(const drive::Run& run);

/// Periods in the scenario that override the DBC's cycle times: "SlaveImu every 5 ms (DBC: 10 ms)".
std::vector<std::string> period_overrides(const scenario::Scenario& scenario);

}  // namespace canhil::report
