// What every report of a run tells, apart from its checks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/results.hpp"
#include "bench/drive/session.hpp"

namespace canhil::report {

/// What an estimator made of the run; its last line counts its answers by their marks.
struct EstimatorResults {
  std::string_view estimator;
  std::vector<estimators::ResultLine> lines;
};

/// Of each estimator that the scenario runs.
std::vector<EstimatorResults> results(const scenario::Scenario& scenario, const drive::Run& run);

/// By which the run went.
std::string_view clock_name(const drive::Run& run);

/// What the latencies were measured with.
std::string_view stamp_source(const drive::Run& run);

/// The message that closes each group of answers of the estimators in use.
std::vector<std::string_view> closing_answers(const scenario::Scenario& scenario);

/// True of the messages that the estimators in use owe the bench.
bool is_due(const scenario::Scenario& scenario, const MessageInfo& message);

/// The bit rates that reports tell the bus load at: that of the bus, or, where it has none, 500 kbit/s and
/// 1 Mbit/s, on CAN FD with a data phase of 2 and 5 Mbit/s.
std::vector<wire::BitRates> load_rates(wire::BitRates known, BusFormat format);
std::vector<wire::BitRates> load_rates(const drive::Run& run);

/// The periods that the scenario sets in place of the DBC's cycle times: "SlaveImu every 5 ms (DBC: 10 ms)".
std::vector<std::string> period_overrides(const scenario::Scenario& scenario);

}  // namespace canhil::report
