#include "bench/report/json_timing.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "bench/checks/timing.hpp"
#include "bench/checks/wire_bounds.hpp"
#include "bench/report/latency_breakdown.hpp"
#include "bench/report/summary.hpp"
#include "bench/report/uncertainty.hpp"

namespace canhil::report {
namespace {

constexpr std::array<std::string_view, 5> stamp_names{"hardware", "kernel", "hub", "process", "virtual_time"};

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

// An object with the keys count, min, p50, p90, p99, p999, max [s] and buckets_us. The value of buckets_us
// has a pair [from, count] for each bucket that is not empty.
Json object(const checks::Histogram& histogram) {
  const checks::Distribution d = checks::distribution_s(histogram);
  Json json{{"count", d.count}, {"min", d.min},   {"p50", d.p50}, {"p90", d.p90},
            {"p99", d.p99},     {"p999", d.p999}, {"max", d.max}, {"buckets_us", Json::array()}};
  for (const checks::Histogram::Bucket& bucket : histogram.buckets())
    json["buckets_us"].push_back(Json::array({bucket.from_us, bucket.count}));
  return json;
}

// An object with two keys: stretch_s is the length of a stretch of time, largest_s is an array with the
// largest value in each stretch from time 0 on. A stretch without a value has the entry null.
Json object(const checks::TimeLine& line) {
  Json json{{"stretch_s", seconds(line.stretch_ns())}, {"largest_s", Json::array()}};
  for (const std::int64_t largest_ns : line.largest_ns())
    json["largest_s"].push_back(largest_ns < 0 ? Json(nullptr) : Json(seconds(largest_ns)));
  return json;
}

Json split_of(const checks::TimingRecord& timing) {
  const checks::LatencyBreakdown& breakdown = timing.breakdown;
  Json json{{"stimuli", breakdown.stimuli},
            {"told_by_target", breakdown.accounted},
            {"total_s", total_s(breakdown)}};
  for (const BreakdownPart& part : parts(timing)) {
    json["parts_s"][std::string(part.key)] = or_null(part.mean_s);
    if (part.bound == Bound::at_least) json["at_least"].push_back(part.key);
    if (part.bound == Bound::at_most) json["at_most"].push_back(part.key);
  }
  for (const auto& [group, of_group] : timing.breakdown_by_group) {
    Json& one = json["groups"][std::string(group)];
    one = {{"stimuli", of_group.stimuli}, {"total_s", total_s(of_group)}};
    for (const BreakdownPart& part : group_parts(timing, of_group))
      one["parts_s"][std::string(part.key)] = or_null(part.mean_s);
  }
  const checks::SlowestAnswer& slowest = timing.slowest;
  if (!slowest.message.empty()) {
    json["slowest"] = {{"message", slowest.message},
                       {"t_s", seconds(slowest.t_ns)},
                       {"latency_s", seconds(slowest.latency_ns)},
                       {"reply_wire_s", seconds(slowest.reply_wire_ns)},
                       {"queue_max_us", slowest.queue_max_us},
                       {"compute_max_us", slowest.compute_max_us}};
  }
  return json;
}

Json wire_of(const checks::Observations& seen) {
  Json json{{"bitrate_bitps", seen.timing.wire.rates.nominal},
            {"no_bounds", checks::no_bounds(seen)},
            {"messages", Json::array()}};
  if (seen.timing.wire.fd) json["data_bitrate_bitps"] = seen.timing.wire.rates.data;
  for (const checks::WireBound& bound : checks::wire_bounds(seen)) {
    json["messages"].push_back(
        {{"name", bound.message},
         {"count", bound.count},
         {"longest_s", seconds(bound.longest_ns)},
         {"at_least", bound.of_target},
         {"frame_s", seconds(bound.frame_ns)},
         {"bound_s", bound.bound_ns ? Json(seconds(*bound.bound_ns)) : Json(nullptr)}});
  }
  return json;
}

// The uncertainty budget of each latency figure: one entry for each influence.
Json uncertainty_of(const std::vector<UncertainLatency>& latencies, const StampConditions& conditions) {
  Json json{{"method", "GUM type B, rectangular: u = a / sqrt(3), of two stamps u = a sqrt(2 / 3); U = k u"},
            {"k", coverage_factor},
            {"left_out", left_out(conditions)},
            {"latency_s", Json::object()}};
  for (const UncertainLatency& one : latencies) {
    Json& message = json["latency_s"][one.message];
    for (const UncertainFigure& figure : one.figures) {
      Json& of = message[std::string(figure.name)];
      of = {{"value", figure.value_s}, {"expanded", figure.expanded_s}};
      for (std::size_t i = 0; i < influence_names.size(); ++i)
        of["half_widths"][std::string(influence_names[i])] = figure.half_width_s[i];
    }
  }
  return json;
}

}  // namespace

void add_timing(Json& page, const scenario::Scenario& scenario, const drive::Run& run) {
  const checks::TimingRecord& timing = run.seen.timing;
  const std::vector<std::string_view> closing = closing_answers(scenario);
  for (std::size_t i = 0; i < timing.messages.size(); ++i) {
    const std::string name(timing.messages[i].name);
    const checks::AnswerTiming& answers = timing.answers[i];
    const bool due = is_due(scenario, timing.messages[i]);
    const std::size_t never_came = due ? checks::unanswered(run.seen, name) : 0;
    if (answers.latency.count() > 0 || answers.unpaired > 0 || never_came > 0) {
      Json& latency = page["latency_s"][name] = object(answers.latency);
      latency["closes_group"] = std::ranges::find(closing, name) != closing.end();
      latency["unanswered"] = never_came;
      latency["unpaired"] = answers.unpaired;
      latency["wrong_counter"] = answers.wrong_counter;
      latency["repeated"] = answers.repeated;
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
  if (const auto latencies = uncertainties(scenario, run); !latencies.empty())
    page["uncertainty"] = uncertainty_of(latencies, stamp_conditions(run));
  if (timing.breakdown.stimuli > 0) page["split"] = split_of(timing);
  if (timing.wire.rates.nominal > 0) page["wire"] = wire_of(run.seen);
  page["bench_lateness_s"] = object(timing.lateness);
  page["bench_lateness_s"]["line"] = object(timing.lateness_line);
}

Json timing_judged(const drive::Run& run) {
  Json json{{"judged", run.timing_unfit.empty()},
            {"why_not", run.timing_unfit},
            {"answer_stamps", Json::object()},
            {"clock_step_s", seconds(run.seen.host.clock_step_ns)},
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
