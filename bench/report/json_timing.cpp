#include "bench/report/json_timing.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "bench/checks/timing.hpp"
#include "bench/report/summary.hpp"

namespace canhil::report {
namespace {

constexpr std::array<std::string_view, 5> stamp_names{"hardware", "kernel", "hub", "process", "virtual_time"};

}  // namespace

Json object(const checks::Histogram& histogram) {
  const checks::Distribution d = checks::distribution_s(histogram);
  Json json{{"count", d.count}, {"min", d.min},   {"p50", d.p50}, {"p90", d.p90},
            {"p99", d.p99},     {"p999", d.p999}, {"max", d.max}, {"buckets_us", Json::array()}};
  for (const checks::Histogram::Bucket& bucket : histogram.buckets())
    json["buckets_us"].push_back(Json::array({bucket.from_us, bucket.count}));
  return json;
}

Json object(const checks::TimeLine& line) {
  Json json{{"stretch_s", static_cast<double>(line.stretch_ns()) * 1e-9}, {"largest_s", Json::array()}};
  for (const std::int64_t largest_ns : line.largest_ns())
    json["largest_s"].push_back(largest_ns < 0 ? Json(nullptr)
                                               : Json(static_cast<double>(largest_ns) * 1e-9));
  return json;
}

void add_timing(Json& page, const scenario::Scenario& scenario, const run::Run& run) {
  const checks::TimingRecord& timing = run.seen.timing;
  const std::vector<std::string_view> closing = closing_answers(scenario);
  for (std::size_t i = 0; i < messages::all_messages.size(); ++i) {
    const std::string name(messages::all_messages[i].name);
    const checks::AnswerTiming& answers = timing.answers[i];
    if (answers.latency.count() > 0 || answers.unpaired > 0) {
      Json& latency = page["latency_s"][name] = object(answers.latency);
      latency["closes_group"] = std::ranges::find(closing, name) != closing.end();
      latency["unanswered"] = checks::unanswered(run.seen, name);
      latency["unpaired"] = answers.unpaired;
      latency["line"] = object(answers.latency_line);
    }
    if (answers.jitter.count() > 0) page["jitter_s"][name] = object(answers.jitter);
    const checks::TransmitTiming& transmit = timing.transmit[i];
    if (transmit.handed_over.count() == 0) continue;
    Json& lateness = page["transmit_lateness_s"][name];
    lateness["handed_over"] = object(transmit.handed_over);
    if (transmit.echoed.count() > 0) lateness["echoed"] = object(transmit.echoed);
    lateness["not_echoed"] = transmit.handed_over.count() - transmit.echoed.count();
  }
  page["bench_lateness_s"] = object(timing.lateness);
  page["bench_lateness_s"]["line"] = object(timing.lateness_line);
}

Json timing_judged(const run::Run& run) {
  Json json{{"judged", run.timing_unfit.empty()},
            {"why_not", run.timing_unfit},
            {"answer_stamps", Json::object()},
            {"clock_step_s", static_cast<double>(run.seen.host.clock_step_ns) * 1e-9},
            {"cpu_run_s", run.seen.host.cpu_run_s},
            {"cpu_wait_s", run.seen.host.cpu_wait_s},
            {"cpu_stolen_share", run.seen.host.stolen_share},
            {"preempted", run.seen.host.preempted}};
  for (std::size_t i = 0; i < stamp_names.size(); ++i) {
    if (run.seen.timing.stamps[i] > 0) json["answer_stamps"][stamp_names[i]] = run.seen.timing.stamps[i];
  }
  return json;
}

}  // namespace canhil::report
