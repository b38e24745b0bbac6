#include "bench/schedulability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace canhil::schedulability {
namespace {

using Json = nlohmann::ordered_json;
using Time = std::optional<std::int64_t>;

std::string_view name_of(Release release) {
  constexpr std::array<std::string_view, 4> names{"cycle", "interval", "option", "once"};
  return names.at(static_cast<std::size_t>(release));
}

/// The time as text: in ms, with three decimals.
std::string milliseconds(const Time& ns, std::string_view none = "-") {
  return ns ? fmt::format("{:.3f}", static_cast<double>(*ns) * 1e-6) : std::string(none);
}

Json seconds(const Time& ns) { return ns ? Json(static_cast<double>(*ns) * 1e-9) : Json(nullptr); }

Time period(const Stream& stream) { return stream.period_ns > 0 ? Time(stream.period_ns) : Time(); }

Time slack(const Stream& stream, const Response& response) {
  return stream.deadline_ns && response.response_ns ? Time(*stream.deadline_ns - *response.response_ns)
                                                    : Time();
}

std::string row(const Stream& stream, const Response& response) {
  return fmt::format("{:<26} {:>8} {:<10} {:<8} {:>9} {:>9} {:>5} {:>7} {:>7} {:>9} {:>9}{}\n", stream.name,
                     fmt::format("{:0{}X}", stream.id, stream.extended ? 8 : 3), stream.sender,
                     name_of(stream.release), milliseconds(period(stream)), milliseconds(stream.deadline_ns),
                     stream.length.bits(), milliseconds(response.transmission_ns),
                     milliseconds(response.blocking_ns), milliseconds(response.response_ns, "none"),
                     milliseconds(slack(stream, response)),
                     meets_deadline(stream, response) ? "" : "  MISSED");
}

bool any(const Analysis& analysis, Release release) {
  return std::ranges::find(analysis.streams, release, &Stream::release) != analysis.streams.end();
}

/// One line for each assumption about event messages that the analysis used.
std::string assumptions(const Analysis& analysis) {
  std::string text;
  if (any(analysis, Release::interval))
    text += "release interval: an event message, no closer than its GenMsgDelayTime\n";
  if (any(analysis, Release::option))
    text += "release option: an event message without GenMsgDelayTime, no closer than --event-interval-ms\n";
  if (any(analysis, Release::once)) {
    text +=
        "release once: an event message without GenMsgDelayTime, assumed to be due once within any "
        "response;\n"
        "  it has no deadline and does not count in the utilisation (--event-interval-ms sets an interval)\n";
  }
  if (analysis.bus.queues == Queues::in_order)
    text += "queues: every node sends its frames in the order in which they became ready\n";
  const ErrorModel& errors = analysis.bus.errors;
  if (errors.burst > 0) {
    text += fmt::format("bus errors: {} at once, and one more every {} ms\n", errors.burst,
                        milliseconds(errors.interval_ns));
  }
  for (const Tolerated& one : analysis.tolerated) {
    const dbc::RuleText& rule = dbc::text_of(one.rule);
    text += fmt::format("warning {}, {} time{}, first in line {}: {}\n  assumed: {}\n", rule.id, one.count,
                        one.count == 1 ? "" : "s", one.first.at.line, one.first.what, rule.consequence);
  }
  return text;
}

std::string missed(const Analysis& analysis) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < analysis.streams.size(); ++i) {
    if (!meets_deadline(analysis.streams[i], analysis.responses[i]))
      names.push_back(analysis.streams[i].name);
  }
  constexpr std::size_t shown = 5;
  const std::size_t more = names.size() - std::min(names.size(), shown);
  names.resize(names.size() - more);
  return fmt::format("{} of {} message{}: {}{}", names.size() + more, analysis.streams.size(),
                     analysis.streams.size() == 1 ? "" : "s", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

Json message(const Stream& stream, const Response& response) {
  return {{"name", stream.name},
          {"id", stream.id},
          {"extended", stream.extended},
          {"sender", stream.sender},
          {"release", name_of(stream.release)},
          {"period_s", seconds(period(stream))},
          {"deadline_s", seconds(stream.deadline_ns)},
          {"jitter_s", seconds(stream.jitter_ns)},
          {"nominal_bits", stream.length.nominal},
          {"data_bits", stream.length.data},
          {"transmission_s", seconds(response.transmission_ns)},
          {"blocking_s", seconds(response.blocking_ns)},
          {"response_s", seconds(response.response_ns)},
          {"slack_s", seconds(slack(stream, response))},
          {"instances", response.instances},
          {"worst_instance", response.worst_instance},
          {"meets_deadline", meets_deadline(stream, response)}};
}

}  // namespace

Analysis analyse(std::string file, std::vector<Stream> streams, const Bus& bus) {
  std::vector<Response> found =
      bus.queues == Queues::in_order ? fifo_responses(streams, bus.rates) : responses(streams, bus);
  return {.file = std::move(file), .bus = bus, .streams = std::move(streams), .responses = std::move(found)};
}

bool schedulable(const Analysis& analysis) {
  for (std::size_t i = 0; i < analysis.streams.size(); ++i) {
    if (!meets_deadline(analysis.streams[i], analysis.responses[i])) return false;
  }
  return true;
}

std::string table(const Analysis& analysis) {
  std::string text =
      fmt::format("{:<26} {:>8} {:<10} {:<8} {:>9} {:>9} {:>5} {:>7} {:>7} {:>9} {:>9}\n", "message", "id",
                  "sender", "release", "T [ms]", "D [ms]", "bits", "C [ms]", "B [ms]", "R [ms]", "slack");
  for (std::size_t i = 0; i < analysis.streams.size(); ++i)
    text += row(analysis.streams[i], analysis.responses[i]);
  const wire::BitRates& rates = analysis.bus.rates;
  text +=
      fmt::format("utilisation {:.2f} % of {} bit/s{}\n", 100 * utilisation(analysis.streams, rates),
                  rates.nominal, rates.data > 0 ? fmt::format(" (FD data phase {} bit/s)", rates.data) : "");
  text += assumptions(analysis);
  if (std::ranges::any_of(analysis.responses, [](const Response& r) { return !r.response_ns; })) {
    text += utilisation(analysis.streams, rates) >= 1
                ? "R none: no bound, the bus is overloaded\n"
                : "R none: the analysis finds no bound; the bus itself is not overloaded\n";
  }
  const std::size_t count = analysis.streams.size();
  text += schedulable(analysis) ? fmt::format("schedulable: {} message{}\n", count, count == 1 ? "" : "s")
                                : fmt::format("NOT schedulable: {}\n", missed(analysis));
  return text;
}

std::string json(const Analysis& analysis) {
  const Bus& bus = analysis.bus;
  Json messages = Json::array();
  for (std::size_t i = 0; i < analysis.streams.size(); ++i)
    messages.push_back(message(analysis.streams[i], analysis.responses[i]));
  Json warnings = Json::array();
  for (const Tolerated& one : analysis.tolerated) {
    const dbc::RuleText& rule = dbc::text_of(one.rule);
    warnings.push_back({{"rule", rule.id},
                        {"count", one.count},
                        {"first_line", one.first.at.line},
                        {"first", one.first.what},
                        {"assumed", rule.consequence}});
  }
  const bool errors = bus.errors.burst > 0;
  const Json root{{"file", analysis.file},
                  {"bitrate_bps", bus.rates.nominal},
                  {"data_bitrate_bps", bus.rates.data > 0 ? Json(bus.rates.data) : Json(nullptr)},
                  {"queues", bus.queues == Queues::in_order ? "fifo" : "priority"},
                  {"error_burst", bus.errors.burst},
                  {"error_interval_s", errors ? seconds(bus.errors.interval_ns) : Json(nullptr)},
                  {"utilisation", utilisation(analysis.streams, bus.rates)},
                  {"schedulable", schedulable(analysis)},
                  {"warnings", std::move(warnings)},
                  {"messages", std::move(messages)}};
  return root.dump(2, ' ', false, Json::error_handler_t::replace) +
         "\n";  // replaces bytes of a file name that are not UTF-8
}

}  // namespace canhil::schedulability
