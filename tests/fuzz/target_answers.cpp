// Tests the bench with a target that may send anything: handshake, run, verdict, reports, and the samples
// that a campaign would store. The input changes the answers of a correct device. Most answers stay
// unchanged, so that runs reach their end and the bench receives changed and unchanged answers together.
#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/campaign/series.hpp"
#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/handshake.hpp"
#include "bench/drive/lockstep.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/of_scenario.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/observe/bus_watch.hpp"
#include "bench/observe/intruders.hpp"
#include "bench/observe/load_meter.hpp"
#include "bench/protocol/contract_watch.hpp"
#include "bench/protocol/monitor.hpp"
#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/report/whole.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/meddler.hpp"

namespace {

using namespace canhil;

struct Prepared {
  scenario::Scenario scenario;
  world::FlightRecord truth;
};

Prepared prepare() {
  auto scenario = scenario::read_file(FLIGHT, drive::contract());
  fuzz::expect(scenario.has_value());
  auto truth = drive::make_truth(*scenario);
  fuzz::expect(truth.has_value());
  return {std::move(*scenario), std::move(*truth)};
}

// Collects the observations of the run, as the session of hil-bench does.
checks::Observations collected(protocol::Monitor& monitor, const observe::BusWatch& bus,
                               const observe::Intruders& intruders, const observe::LoadMeter& load,
                               const drive::Link& link) {
  checks::Observations seen = monitor.finish();
  seen.bus = bus.record();
  seen.bus.intruded = intruders.frames();
  seen.bit_rates = link.port().capabilities().wire.rates;
  seen.length_by_second = load.lengths();
  seen.bus.reports_errors = true;
  return seen;
}

// Writes all reports of a run. The JSON report must be complete, and the bench must be able to make a page
// from it.
void report_all(const scenario::Scenario& scenario, const drive::Run& run) {
  fuzz::expect(!report::text(scenario, run).empty());
  fuzz::expect(!report::junit(scenario, run).empty());
  std::size_t csv_bytes = 0;
  report::csv(scenario, run, [&](std::string_view part) { csv_bytes += part.size(); });
  fuzz::expect(csv_bytes > 0);
  const auto document = report::document(scenario, run);
  const std::string lacks = report::why_not_whole(document);
  if (!lacks.empty()) std::fprintf(stderr, "the report is not whole: %s\n", lacks.c_str());
  fuzz::expect(lacks.empty() && report::html(document).has_value());
}

void fly(const Prepared& prepared, std::uint8_t how, std::span<const std::uint8_t> script) {
  // The input selects reports rarely, because they take far longer than the run.
  enum : std::uint8_t { lockstep = 1, samples = 2, reports = 0xE0 };
  const auto& [scenario, truth] = prepared;
  static const std::atomic<bool> never = false;
  auto flight = drive::make_flight(scenario, truth, 0);
  fuzz::expect(flight.has_value());
  fuzz::Meddler port(script);
  drive::Link link(port);
  drive::Schedule schedule =
      drive::make_schedule(scenario, truth, flight->per_run_truth, 0, (how & lockstep) != 0);
  observe::BusWatch bus(port);
  observe::Intruders intruders{messages::all_messages};
  const drive::Attached bus_watched(link, bus), intruders_watched(link, intruders);
  const auto ready = drive::configure(link, schedule.outbox(), scenario.targets, flight->initial,
                                      [] { return std::nullopt; });
  if (!ready) return fuzz::expect_words(ready.error().message);

  protocol::Monitor monitor(protocol::Asked{.windows = checks::timed_windows(scenario.checks),
                                            .wire = port.capabilities().wire,
                                            .takers = estimators::takers(scenario),
                                            .own_interval_s = estimators::own_intervals_s(scenario)});
  observe::LoadMeter load(BusFormat::classic, observe::LoadBy::stamps);
  drive::Ending ending;
  protocol::ContractWatch watch;
  {
    const drive::Attached monitored(link, monitor), loaded(link, load), listening(link, schedule);
    const auto progress = [](std::int64_t) {};
    ending = (how & lockstep) != 0
                 ? drive::run_lockstep(link, schedule, watch, 1, never, progress)
                 : drive::run_real_time(link, schedule, watch, 400'000'000, never, progress);
  }
  drive::stop(link, schedule.outbox(), scenario.targets);
  checks::Observations seen = collected(monitor, bus, intruders, load, link);
  std::string timing_unfit = checks::unfit_for_timing(seen);
  const checks::Verdict verdict =
      checks::judge(scenario, {.seen = seen,
                               .truth = drive::truth_of(truth, flight->per_run_truth, scenario.duration_us),
                               .estimators = estimators::all(),
                               .ended_early = ending.detail,
                               .timing_unfit = timing_unfit});
  fuzz::expect(verdict.checks.size() >= scenario.checks.size());
  if ((how & samples) != 0) {
    for (const estimators::Estimator* one : estimators::all()) {
      const auto series = campaign::samples_of(seen, flight->per_run_truth, truth, *one);
      const auto again = quantities::decode(quantities::encode(series), one->layout);
      fuzz::expect(again && again->size() == series.size());
    }
  }
  if ((how & reports) == reports) {
    report_all(scenario, {.verdict = verdict,
                          .ending = ending,
                          .seen = std::move(seen),
                          .truth = truth,
                          .per_run_truth = std::move(flight->per_run_truth),
                          .options = {},
                          .clock = drive::ClockKind::simulated_wire,
                          .timing_unfit = std::move(timing_unfit)});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Prepared prepared = prepare();
  if (size > 0) fly(prepared, data[0], {data + 1, size - 1});
  return 0;
}
