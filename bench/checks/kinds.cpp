// One line for each kind of check.
#include <array>
#include <vector>

#include "bench/checks/judge.hpp"
#include "bench/checks/kinds/answering.hpp"
#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/checks/kinds/bus_load.hpp"
#include "bench/checks/kinds/command.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/convergence.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/checks/kinds/counts_match.hpp"
#include "bench/checks/kinds/delay.hpp"
#include "bench/checks/kinds/detected_within.hpp"
#include "bench/checks/kinds/error.hpp"
#include "bench/checks/kinds/flag.hpp"
#include "bench/checks/kinds/heartbeat.hpp"
#include "bench/checks/kinds/honest.hpp"
#include "bench/checks/kinds/latency.hpp"
#include "bench/checks/kinds/latency_growth.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/kinds/own_times.hpp"
#include "bench/checks/kinds/program.hpp"
#include "bench/checks/kinds/protection.hpp"
#include "bench/checks/kinds/recovers_within.hpp"
#include "bench/checks/kinds/response.hpp"
#include "bench/checks/kinds/sigma.hpp"
#include "bench/checks/kinds/sigma_grows.hpp"
#include "bench/checks/kinds/wire_response.hpp"

namespace canhil::checks {
namespace {

constexpr std::array of_any_estimator{check_kind<Error>,
                                      check_kind<Convergence>,
                                      check_kind<Consistency>,
                                      check_kind<Sigma>,
                                      check_kind<Answers>,
                                      check_kind<Latency>,
                                      check_kind<LatencyGrowth>,
                                      check_kind<DelayBelow>,
                                      check_kind<OutputPeriod>,
                                      check_kind<OwnTimes>,
                                      check_kind<Heartbeat>,
                                      check_kind<Counters>,
                                      check_kind<CountsMatch>,
                                      check_kind<Protection>,
                                      check_kind<BusLoad>,
                                      check_kind<BusErrorLimits>,
                                      check_kind<WireResponseRule>,
                                      check_kind<DetectedWithin>,
                                      check_kind<RecoversWithin>,
                                      check_kind<SigmaGrows>,
                                      check_kind<Honest>,
                                      check_kind<Answering>,
                                      check_kind<Flag>,
                                      check_kind<Response>,
                                      check_kind<CommandTime>,
                                      check_kind<Program>};

}  // namespace

std::vector<scenario::CheckKind> kinds(std::span<const estimators::Estimator* const> estimators) {
  std::vector<scenario::CheckKind> all(of_any_estimator.begin(), of_any_estimator.end());
  for (const estimators::Estimator* one : estimators)
    all.insert(all.end(), one->check_kinds.begin(), one->check_kinds.end());
  return all;
}

}  // namespace canhil::checks
