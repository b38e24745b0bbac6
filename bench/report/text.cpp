#include "bench/report/run_reports.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <iterator>

#include "bench/checks/bus_load.hpp"
#include "bench/checks/timing.hpp"
#include "bench/checks/wire_bounds.hpp"
#include "bench/report/latency_breakdown.hpp"
#include "bench/report/summary.hpp"
#include "bench/report/uncertainty.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/version/version.hpp"

namespace canhil::report {

std::string label(std::string_view outcome) {
  std::string label(outcome);
  for (char& c : label) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return label;
}

namespace {

std::string to_text(const estimators::ResultLine& line) {
  std::string text;
  for (const estimators::Figure& figure : line.figures) {
    if (!figure.text.empty()) text += (text.empty() ? "" : ", ") + figure.text;
  }
  return fmt::format("  {:<29} {}\n", line.what, text.empty() ? "none" : text);
}

// The counts of bus errors, then one line for each event, with the time since the bench's first transmission
// and the error counters.
std::string to_text(const checks::BusRecord& bus, std::int64_t first_ns) {
  constexpr std::size_t shown = 20;
  std::string lines = fmt::format("  bus                           {} error frames", bus.errors.frames);
  if (const std::string said = canhil::to_text(bus.errors); !said.empty())
    lines += fmt::format(" ({})", said);
  lines += fmt::format("; interface down {} times; late in transmit queue {} frames", bus.downs,
                       bus.late_in_queue);
  if (bus.foreign > 0)
    lines += fmt::format("; {} frames in the wrong format (classic CAN or CAN FD)", bus.foreign);
  lines += '\n';
  for (const std::string& note : bus.notes) lines += fmt::format("    {}\n", one_line(note));
  for (const checks::BusIncident& incident : bus.incidents) {
    if (&incident == bus.incidents.data() + shown) break;
    lines += fmt::format("    t={:.3f} s  {} (tx {}, rx {})\n",
                         static_cast<double>(incident.t_ns - first_ns) * 1e-9, name(incident.event),
                         incident.tx_counter, incident.rx_counter);
  }
  const std::size_t more = bus.incidents.size() + bus.more_incidents;
  if (more > shown) lines += fmt::format("    and {} more\n", more - shown);
  return lines;
}

double in_ms(std::int64_t ns) { return static_cast<double>(ns) * 1e-6; }

std::string milliseconds(const checks::Distribution& d) {
  return fmt::format("p50 {:.3f}  p90 {:.3f}  p99 {:.3f}  p99.9 {:.3f}  max {:.3f} ms", d.p50 * 1e3,
                     d.p90 * 1e3, d.p99 * 1e3, d.p999 * 1e3, d.max * 1e3);
}

std::string limited_us(std::uint16_t us) {
  return us < checks::most_reported_us ? fmt::format("{} us", us) : fmt::format("{} us or more", us);
}

std::string load_words(const drive::Run& run) {
  std::string lines;
  for (const wire::BitRates& rates : load_rates(run)) {
    const checks::Load load = checks::bus_load(run.seen, rates);
    lines += fmt::format("  bus load at {:<17} mean {:.1f} %, busiest second {:.1f} %\n",
                         checks::to_text(rates), load.mean * 100, load.busiest * 100);
  }
  return lines;
}

// Latency of the last message of each group; messages without a latency come first.
std::string latency_words(const scenario::Scenario& scenario, const checks::Observations& seen,
                          bool lockstep) {
  std::string none, lines;
  for (const std::string_view message : closing_answers(scenario)) {
    const auto place = std::ranges::find(seen.timing.messages, message, &MessageInfo::name);
    const checks::AnswerTiming& timing =
        seen.timing.answers[static_cast<std::size_t>(place - seen.timing.messages.begin())];
    const std::uint64_t answers = timing.latency.count();
    const std::size_t unanswered = checks::unanswered(seen, message);
    const std::string missing = unanswered > 0 ? fmt::format(", {} never came", unanswered) : "";
    if (answers == 0) {
      none += fmt::format("  latency {:<22}no answers{}\n", message, missing);
    } else if (!lockstep) {
      lines += fmt::format("  latency {:<22}{}  of {} answers{}\n", message,
                           milliseconds(checks::distribution_s(timing.latency)), answers, missing);
      lines += fmt::format("    its period's deviation      {}\n",
                           milliseconds(checks::distribution_s(timing.jitter)));
    } else if (unanswered > 0) {
      none +=
          fmt::format("  latency {:<22}none in virtual time, of {} answers{}\n", message, answers, missing);
    }
  }
  return none + lines;
}

// The parts of the mean latency, and the slowest answer with the target's report for the same time.
std::string split_words(const checks::TimingRecord& timing) {
  if (timing.breakdown.stimuli == 0) return "";
  std::string lines = fmt::format("  from stimulus to answer       mean {:.3f} ms of {} stimuli, of it\n",
                                  total_s(timing.breakdown) * 1e3, timing.breakdown.stimuli);
  for (const BreakdownPart& part : parts(timing)) {
    const char* bound = part.bound == Bound::at_least  ? " (at least: the target reports no more)"
                        : part.bound == Bound::at_most ? " (at most)"
                                                       : "";
    if (part.mean_s) lines += fmt::format("    {:>8.3f} ms  {}{}\n", *part.mean_s * 1e3, part.what, bound);
  }
  if (timing.breakdown_by_group.size() > 1) {
    for (const auto& [group, breakdown] : timing.breakdown_by_group)
      lines += fmt::format("    {:>8.3f} ms  in all for {} alone, mean of its {} stimuli\n",
                           total_s(breakdown) * 1e3, group, breakdown.stimuli);
  }
  const checks::SlowestAnswer& slowest = timing.slowest;
  if (slowest.message.empty()) return lines;
  lines += fmt::format(
      "    slowest: {} after {:.3f} ms at t={:.3f} s; in that 0.1 s the target's longest wait was "
      "{}, its longest computing {}\n",
      slowest.message, in_ms(slowest.latency_ns), static_cast<double>(slowest.t_ns) * 1e-9,
      limited_us(slowest.queue_max_us), limited_us(slowest.compute_max_us));
  return lines;
}

// The bus response times of messages, compared with their bounds: the message that is nearest to its bound,
// and all messages beyond their bounds.
std::string wire_words(const checks::Observations& seen) {
  if (seen.bit_rates.nominal == 0) return "";
  if (const std::string why = checks::no_bounds(seen); !why.empty())
    return fmt::format("  over the bus                  not compared with bounds: {}\n", why);
  std::vector<checks::WireBound> bounds = checks::wire_bounds(seen);
  const std::string messages = fmt::format("{} message{}", bounds.size(), bounds.size() == 1 ? "" : "s");
  std::erase_if(bounds, [](const checks::WireBound& bound) { return !bound.bound_ns; });
  if (bounds.empty())
    return fmt::format("  over the bus                  {}, the analysis finds a bound for none\n", messages);
  const checks::WireBound& nearest =
      *std::ranges::max_element(bounds, {}, [](const checks::WireBound& bound) {
        return static_cast<double>(bound.longest_ns) / static_cast<double>(*bound.bound_ns);
      });
  std::string lines = fmt::format(
      "  over the bus                  bounds for {} of {}; nearest {}: {:.3f} of {:.3f} ms\n", bounds.size(),
      messages, nearest.message, in_ms(nearest.longest_ns), in_ms(*nearest.bound_ns));
  for (const checks::WireBound& bound : bounds) {
    if (bound.longest_ns > *bound.bound_ns)
      lines += fmt::format("    beyond: {} {:.3f} ms, bound {:.3f} ms\n", bound.message,
                           in_ms(bound.longest_ns), in_ms(*bound.bound_ns));
  }
  return lines;
}

// When the worst value of a check that failed came, unless its own words say so.
std::string worst_words(const checks::CheckResult& check) {
  const auto& worst_at_us = check.judgement.measurement.worst_at_us;
  if (check.outcome != checks::Outcome::fail || !worst_at_us) return "";
  const std::string at = fmt::format(" {:g} s", static_cast<double>(*worst_at_us) / 1e6);
  return check.measured.find(at) != std::string::npos ? "" : ", worst at" + at;
}

}  // namespace

std::string text(const scenario::Scenario& scenario, const drive::Run& run) {
  std::string page;

  page += one_line(scenario.title) + "\n";
  page += fmt::format("  scenario {} · bus {}{} · {} · {:g} s in {:.2f} s\n", one_line(scenario.file),
                      one_line(run.options.bus.text),
                      run.options.format == BusFormat::fd          ? " · CAN FD (canhil-fd)"
                      : run.options.format == BusFormat::fd_frames ? " · CAN FD"
                                                                   : "",
                      clock_name(run), static_cast<double>(scenario.duration_us) * 1e-6, run.wall_s);

  if (!scenario.binding->files.empty())
    page += fmt::format("  by {}\n", one_line(to_text(scenario.binding->files)));
  page += fmt::format("  canhil {} (revision {}){}{}\n", version_text(), revision(),
                      run.seen.target_version.empty() ? "" : " · target " + run.seen.target_version,
                      run.options.operator_name.empty() ? "" : " · operator " + run.options.operator_name);
  for (const drive::Adapter& adapter : run.adapters) {
    if (adapter.kind != "virtual") page += fmt::format("  adapter {}\n", to_text(adapter));
  }
  for (const auto& [node, bus] : run.options.bus_of) page += fmt::format("  {} on bus {}\n", node, bus);
  if (run.host) {
    page +=
        fmt::format("  bench {}{}\n", realtime::to_text(*run.host),
                    run.options.spin_ns > 0 ? fmt::format(", spin {} us", run.options.spin_ns / 1000) : "");
  }
  for (const scenario::Setting& one : scenario.settings)
    page += fmt::format("  set {} = {}\n", one_line(one.key), one_line(one.value));
  for (const std::string& line : period_overrides(scenario)) page += fmt::format("  {}\n", line);
  for (const faults::FaultReport& fault : run.faults)
    page += fmt::format("  fault '{}' of the {}: {}\n", one_line(fault.name), faults::name(fault.stage),
                        fault.count == 0   ? "did not strike"
                        : fault.count == 1 ? "struck once"
                                           : fmt::format("struck {} times", fault.count));
  page += '\n';

  std::size_t width = 5;
  for (const checks::CheckResult& check : run.verdict.checks) width = std::max(width, check.name.size());
  for (const checks::CheckResult& check : run.verdict.checks) {
    page += one_line(fmt::format("  {:<12}  {:<{}}  {}{}  (expected {})", label(checks::name(check.outcome)),
                                 check.name, width, check.measured, worst_words(check), check.expected)) +
            "\n";
  }

  page += '\n';
  for (const EstimatorResults& one : results(scenario, run)) {
    if (scenario.targets.size() > 1) page += fmt::format("  {}\n", one.estimator);
    for (const estimators::ResultLine& line : one.lines) page += to_text(line);
  }
  const bool lockstep = run.clock == drive::ClockKind::lockstep;
  page += latency_words(scenario, run.seen, lockstep);
  if (!lockstep) {
    const checks::Distribution lateness_s = checks::distribution_s(run.seen.timing.lateness);
    page += fmt::format("  bench's own lateness          {}  of {} frames  (latency by {})\n",
                        milliseconds(lateness_s), lateness_s.count, stamp_source(run));
    page += uncertainty_text(scenario, run);
    page += split_words(run.seen.timing) + wire_words(run.seen);
    if (run.seen.target_timing_seen) {
      page += fmt::format("  target's own account          queue max {}  compute max {}\n",
                          limited_us(run.seen.queue_max_us), limited_us(run.seen.compute_max_us));
    }
  }
  page += load_words(run);
  if (run.seen.reports.heartbeats() > 0)
    page += fmt::format("  target's heartbeat            {}\n", run.seen.reports.to_text());
  const auto& counters = run.seen.counters;
  page += fmt::format(
      "  lost on the way to the target {}; from the target {} frames, {} bad; bench overflow {}\n",
      counters ? fmt::format("{} frames, {} bad CRC, {} bad groups, {} late", counters->frames_lost,
                             counters->bad_crc, counters->bad_group, counters->late)
               : "unknown",
      run.seen.lost_from_target(), run.seen.spoilt_from_target(), run.seen.receive_overflows);

  page += to_text(run.seen.bus, run.seen.first_ns);

  page += fmt::format("\n{}: {}\n", checks::name(run.verdict.outcome), one_line(run.verdict.reason));
  return page;
}

}  // namespace canhil::report
