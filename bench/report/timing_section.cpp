#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/checks/timing_record.hpp"
#include "bench/report/latency_breakdown.hpp"
#include "bench/report/run_sections.hpp"

namespace canhil::report {
namespace {

// A row of a table: the cell `first`, then the count and the percentiles of a distribution.
std::vector<std::string> percentiles(std::string first, const Json& distribution) {
  std::vector<std::string> cells{std::move(first), distribution.at("count").dump()};
  const bool none = distribution.at("count").get<std::uint64_t>() == 0;
  for (const char* key : {"min", "p50", "p90", "p99", "p999", "max"})
    cells.push_back(none ? "&ndash;" : ms(distribution, key));
  return cells;
}

std::vector<std::string> percentile_head(const char* first) {
  return {first, "count", "min ms", "p50", "p90", "p99", "p99.9", "max"};
}

// Returns "&ge; " or "&le; " if only a bound of the part is known.
const char* bound_of(const Json& breakdown, const std::string& part) {
  const auto listed = [&](const char* key) {
    return breakdown.contains(key) &&
           std::ranges::any_of(breakdown.at(key), [&](const Json& one) { return one == part; });
  };
  return listed("at_least") ? "&ge; " : listed("at_most") ? "&le; " : "";
}

// The parts of the mean latency for each group of stimuli, because the mean over all stimuli hides groups
// that are answered rarely.
std::string group_table(const Json& breakdown) {
  if (!breakdown.contains("groups") || breakdown.at("groups").size() < 2) return "";
  std::vector<std::string> head{"part, by stimulus"};
  Rows rows;
  for (const auto& [group, one] : breakdown.at("groups").items()) {
    head.push_back(fmt::format("{} ms ({})", escaped(group), one.at("stimuli").dump()));
    std::size_t row = 0;
    const auto add = [&](const std::string& what, const std::string& value) {
      if (rows.size() == row) rows.push_back({what});
      rows[row++].push_back(value);
    };
    for (const auto& [key, mean] : one.at("parts_s").items())
      add(escaped(std::string(what_of(key))), ms_or_none(mean));
    add("<b>in all</b>", fmt::format("<b>{:.3f}</b>", one.at("total_s").get<double>() * 1e3));
  }
  return table(head, rows, "figures") +
         "<p class=\"note\">The target reports its waits and its computing for all stimuli together.</p>\n";
}

// The parts of the time from stimulus to answer.
std::string split_table(const Json& report) {
  if (!report.contains("split")) return "";
  const Json& breakdown = report.at("split");
  const double total_s = breakdown.at("total_s").get<double>();
  Rows rows;
  for (const auto& [key, mean] : breakdown.at("parts_s").items()) {
    const std::string share =
        mean.is_null() || total_s <= 0 ? "" : fmt::format("{:.1f} %", mean.get<double>() / total_s * 100);
    rows.push_back({escaped(std::string(what_of(key))), bound_of(breakdown, key) + ms_or_none(mean), share});
  }
  rows.push_back({"<b>from the hand-over of the stimulus to the last frame of its answer</b>",
                  fmt::format("<b>{:.3f}</b>", total_s * 1e3), ""});
  std::string out = fmt::format("<h3>Where the time went: mean of {} answered stimuli</h3>\n",
                                breakdown.at("stimuli").dump());
  out += table({"part", "ms", "share"}, rows, "figures");
  if (breakdown.contains("at_least"))
    out += not_known(
        fmt::format("The target reports no times beyond {} us: it took longer.", checks::most_reported_us));
  out += group_table(breakdown);
  if (!breakdown.contains("slowest")) return out;
  const Json& slowest = breakdown.at("slowest");
  const auto reported = [&](const char* key) {
    const auto us = slowest.at(key).get<std::int64_t>();
    return fmt::format("{} us{}", us, us < checks::most_reported_us ? "" : " or more");
  };
  return out +
         fmt::format(
             "<p class=\"note\">The slowest answer, {} at {:.3f} s, took {:.3f} ms; in that 0.1 s the target "
             "reported a longest wait of {} and a longest computing of {}.</p>\n",
             text_in(slowest.at("message")), slowest.at("t_s").get<double>(),
             slowest.at("latency_s").get<double>() * 1e3, reported("queue_max_us"),
             reported("compute_max_us"));
}

// The uncertainty of each latency, and its sources with their half-widths.
std::string uncertainty_table(const Json& report) {
  if (!report.contains("uncertainty")) return "";
  const Json& uncertainty = report.at("uncertainty");
  const auto us = [](const Json& seconds) { return fmt::format("{:.2f}", seconds.get<double>() * 1e6); };
  std::vector<std::string> head{"latency of", "ms", "U ms"};
  Rows rows;
  for (const auto& [message, figures] : uncertainty.at("latency_s").items()) {
    for (const auto& [name, one] : figures.items()) {
      std::vector<std::string>& row = rows.emplace_back();
      row = {escaped(fmt::format("{}, {}", message, name)), ms(one, "value"),
             "&plusmn; " + ms(one, "expanded")};
      for (const auto& [influence, half_width] : one.at("half_widths").items()) {
        if (rows.size() == 1) head.push_back(escaped(influence) + " &micro;s");
        row.push_back(us(half_width));
      }
    }
  }
  std::string out = fmt::format(
      "<h3>Uncertainty of the latencies</h3>\n{}<p class=\"note\">U = k u with k = {}; the columns behind it "
      "are "
      "half-widths. {}.</p>\n",
      table(head, rows, "figures"), text_in(uncertainty.at("k")), text_in(uncertainty.at("method")));
  for (const Json& what : uncertainty.at("left_out"))
    out += not_known(fmt::format("Not in it: {}.", what.get<std::string>()));
  return out;
}

}  // namespace

std::string timing_section(const Json& report) {
  std::string out;
  const auto whole = [&out] { return section("timing", "Latency and jitter", out); };
  const Json& timing = report.at("timing");
  if (!timing.at("judged").get<bool>())
    out += not_known(fmt::format("Timing is not judged: {}.", timing.at("why_not").get<std::string>()));
  if (!report.contains("bench_lateness_s")) return whole();
  out += fmt::format(
      "<p>Latency is from the last frame of the stimulus on the bus to the answer on the bus, by {}."
      " Times in ms.</p>\n",
      text_in(report.at("provenance").at("latency_stamps")));
  const Json none = Json::object();
  const Json& latencies = report.contains("latency_s") ? report.at("latency_s") : none;
  const Json& jitters = report.contains("jitter_s") ? report.at("jitter_s") : none;
  // The last message of an answer group represents the group; the other messages are in a collapsed table.
  Rows rows, others;
  std::string figures;
  for (const auto& [message, latency] : latencies.items()) {
    const bool closes = latency.at("closes_group").get<bool>();
    std::vector<std::string>& row = (closes ? rows : others).emplace_back();
    row = percentiles(escaped(message), latency);
    row.push_back(latency.at("unanswered").dump());
    if (!closes) continue;
    figures += fmt::format("<h3>{}</h3>\n", escaped(message));
    if (latency.at("count").get<std::uint64_t>() == 0) {
      figures += fmt::format(
          "<p>{}</p>\n",
          outcome_words("fail", fmt::format("No answers: {} never came.", latency.at("unanswered").dump())));
      continue;
    }
    std::string its = histogram("Latency", latency) + course("Latency over time", latency.at("line"));
    if (jitters.contains(message)) its += histogram("Deviation of its period", jitters.at(message));
    figures += grid(its);
  }
  const Json& lateness = report.at("bench_lateness_s");
  figures += "<h3>The bench itself</h3>\n" +
             grid(histogram("Lateness", lateness) + course("Lateness over time", lateness.at("line")));
  auto head = percentile_head("latency of");
  head.push_back("never came");
  if (!rows.empty()) out += table(head, rows, "figures");
  if (!others.empty())
    out += folded("Latency of the frames before the last of each answer", table(head, others, "figures"));
  out += uncertainty_table(report) + split_table(report) + figures;
  rows.clear();
  for (const auto& [message, jitter] : jitters.items()) rows.push_back(percentiles(escaped(message), jitter));
  out += folded("Deviation from the period, by message",
                table(percentile_head("deviation of"), rows, "figures"));
  rows.clear();
  if (report.contains("transmit_lateness_s")) {
    for (const auto& [message, its] : report.at("transmit_lateness_s").items()) {
      rows.push_back(percentiles(escaped(message) + ", handed over", its.at("handed_over")));
      if (its.contains("echoed"))
        rows.push_back(percentiles(escaped(message) + ", on the bus", its.at("echoed")));
    }
  }
  out += folded("Lateness of the bench, by message", table(percentile_head("message"), rows, "figures"));
  return whole();
}

}  // namespace canhil::report
