#include "bench/report/page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/checks/bus_load.hpp"
#include "bench/checks/timing_record.hpp"
#include "bench/report/latency_breakdown.hpp"

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

// A collapsed table.
std::string folded(std::string_view summary, const std::vector<std::string>& head, const Rows& rows) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>", summary, table(head, rows, "figures"));
}

// Counts of events as rows of name and number, without counts that are 0.
void add_incidents(Rows& rows, const Json& object, std::string_view of) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_number() && value.get<double>() != 0)
      rows.push_back({escaped(fmt::format("{}: {}", of, key)), text_in(value)});
  }
}

// An object in a list is labelled by its role or, if it has no role, by its bus.
const char* item_key(const Json& item) { return item.contains("role") ? "role" : "bus"; }
std::string item_name(const Json& item) { return item.value(item_key(item), "?"); }
Json without_name(Json item) {
  item.erase(item_key(item));
  return item;
}

// Nested objects as rows "a: b".
void add_rows(Rows& rows, const std::string& name, const Json& value) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      add_rows(rows, name.empty() ? key : fmt::format("{}: {}", name, key), inner);
  } else if (value.is_array()) {
    // The rows of a file are labelled by the role of the file; the rows of an adapter are labelled by its
    // bus.
    if (!value.empty() && value.front().is_object()) {
      for (const Json& item : value)
        add_rows(rows, fmt::format("{}: {}", name, item_name(item)), without_name(item));
      return;
    }
    std::string list;
    for (const Json& item : value) list += (list.empty() ? "" : ", ") + text_in(item);
    rows.push_back({escaped(name), list.empty() ? "none" : list});
  } else {
    rows.push_back({escaped(name), text_in(value)});
  }
}

std::string ms_or_none(const Json& seconds) {
  return seconds.is_null() ? "not known" : fmt::format("{:.3f}", seconds.get<double>() * 1e3);
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
    out +=
        fmt::format("<p class=\"unknown\">? The target reports no times beyond {} us: it took longer.</p>\n",
                    checks::most_reported_us);
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
    out += fmt::format("<p class=\"unknown\">? Not in it: {}.</p>\n", text_in(what));
  return out;
}

// Each message's longest bus response time with its bound.
std::string wire_table(const Json& report) {
  if (!report.contains("wire")) return "";
  const Json& wire = report.at("wire");
  const canhil::wire::BitRates rates{.nominal = wire.at("bitrate_bitps").get<std::int64_t>(),
                                     .data = wire.value("data_bitrate_bitps", std::int64_t{0})};
  std::string out = fmt::format("<h3>Over the bus at {}, beside the bound</h3>\n", checks::to_text(rates));
  if (const std::string why = text_in(wire.at("no_bounds")); !why.empty())
    out += fmt::format("<p class=\"unknown\">? Bounds do not hold in this run: {}.</p>\n", why);
  Rows rows;
  for (const Json& message : wire.at("messages")) {
    const double longest_s = message.at("longest_s").get<double>();
    const Json& bound = message.at("bound_s");
    const bool beyond = !bound.is_null() && longest_s > bound.get<double>();
    rows.push_back(
        {text_in(message.at("name")), message.at("count").dump(), ms_or_none(message.at("frame_s")),
         fmt::format("{}{:.3f}", message.at("at_least").get<bool>() ? "&ge; " : "", longest_s * 1e3),
         bound.is_null() ? "none" : ms_or_none(bound),
         bound.is_null() ? "?"
         : beyond        ? "<span class=\"no\">&#10007; beyond</span>"
                         : fmt::format("{:.0f} %", longest_s / bound.get<double>() * 100)});
  }
  return out + table({"message", "count", "frame ms", "longest ms", "bound ms", "of it"}, rows, "figures");
}

}  // namespace

std::string series_id(std::size_t number) { return fmt::format("series-{}", number); }

namespace {

// The name of a check, as a link to the first plot with its limit.
std::string linked(const Json& check, const Json& all_series) {
  std::size_t number = 0;
  for (const Json& series : all_series) {
    const Json none = Json::array();
    for (const Json& bar : series.contains("bars") ? series.at("bars") : none) {
      if (bar.at("check") == check.at("name"))
        return fmt::format("<a href=\"#{}\">{}</a>", series_id(number), text_in(check.at("name")));
    }
    ++number;
  }
  return text_in(check.at("name"));
}

}  // namespace

std::string checks_section(const Json& report) {
  Rows rows;
  for (const Json& check : report.at("checks")) {
    const std::string outcome = check.at("outcome").get<std::string>();
    const auto [style, sign] = look_of(outcome);
    const std::string requirement = text_in(check.at("requirement"));
    rows.push_back({linked(check, report.at("series")),
                    fmt::format("<span class=\"{}\">{} {}</span>", style, sign, escaped(outcome)),
                    text_in(check.at("measured")), text_in(check.at("expected")),
                    requirement.empty() ? "&ndash;" : requirement});
  }
  return "<section id=\"checks\"><h2>Checks</h2>\n" +
         table({"check", "outcome", "measured", "expected", "requirement"}, rows) + "</section>\n";
}

std::string timing_section(const Json& report) {
  std::string out = "<section id=\"timing\"><h2>Latency and jitter</h2>\n";
  const Json& timing = report.at("timing");
  if (!timing.at("judged").get<bool>())
    out +=
        fmt::format("<p class=\"unknown\">? Timing is not judged: {}.</p>\n", text_in(timing.at("why_not")));
  if (!report.contains("bench_lateness_s")) return out + "</section>\n";
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
      figures += fmt::format("<p class=\"no\">&#10007; No answers: {} never came.</p>\n",
                             latency.at("unanswered").dump());
      continue;
    }
    figures += "<div class=\"grid\">\n";
    figures += histogram("Latency", latency);
    figures += course("Latency over time", latency.at("line"));
    if (jitters.contains(message)) figures += histogram("Deviation of its period", jitters.at(message));
    figures += "</div>\n";
  }
  figures += "<h3>The bench itself</h3>\n<div class=\"grid\">\n";
  figures += histogram("Lateness", report.at("bench_lateness_s"));
  figures += course("Lateness over time", report.at("bench_lateness_s").at("line")) + "</div>\n";
  auto head = percentile_head("latency of");
  head.push_back("never came");
  if (!rows.empty()) out += table(head, rows, "figures");
  if (!others.empty())
    out += folded("Latency of the frames before the last of each answer", head, others) + "\n";
  out += uncertainty_table(report) + split_table(report) + figures;
  rows.clear();
  for (const auto& [message, jitter] : jitters.items()) rows.push_back(percentiles(escaped(message), jitter));
  out += folded("Deviation from the period, by message", percentile_head("deviation of"), rows) + "\n";
  rows.clear();
  if (report.contains("transmit_lateness_s")) {
    for (const auto& [message, lateness] : report.at("transmit_lateness_s").items()) {
      rows.push_back(percentiles(escaped(message) + ", handed over", lateness.at("handed_over")));
      if (lateness.contains("echoed"))
        rows.push_back(percentiles(escaped(message) + ", on the bus", lateness.at("echoed")));
    }
  }
  return out + folded("Lateness of the bench, by message", percentile_head("message"), rows) + "</section>\n";
}

std::string bus_section(const Json& report) {
  const Json& load = report.at("bus_load_line");
  const double stretch_s = load.at("stretch_s").get<double>();
  std::string out = "<section id=\"bus\"><h2>Bus</h2>\n<div class=\"grid\">\n";
  const double data_bitrate = load.at("data_bitrate_bitps").get<double>();
  out += figure(
      fmt::format("Load at {:g} kbit/s{}", load.at("bitrate_bitps").get<double>() / 1e3,
                  data_bitrate > 0 ? fmt::format(", data {:g} kbit/s", data_bitrate / 1e3) : ""),
      from_zero("Bus load", "%", stretch_s, load.at("busiest"), 100),
      fmt::format(
          "by {:g} s, from the exact length of every frame; the last second is left out where it is not "
          "the only one: the run ends within it",
          stretch_s));
  out += "</div>\n" + wire_table(report) + "<h3>Lost and broken</h3>\n";
  Rows rows;
  add_incidents(rows, report.at("bus"), "bus");
  add_incidents(rows, report.at("from_target"), "from the target");
  if (report.contains("target_counters")) add_incidents(rows, report.at("target_counters"), "to the target");
  if (report.contains("target_heartbeat")) {
    for (const Json& said : report.at("target_heartbeat").at("reports"))
      rows.push_back({escaped(fmt::format("heartbeat of {}: {}", text_in(said.at("estimator")),
                                          text_in(said.at("what")))),
                      fmt::format("from {:g} s", said.at("from_s").get<double>())});
  }
  if (report.contains("latency_s")) {
    for (const auto& [message, latency] : report.at("latency_s").items()) {
      if (latency.at("unanswered").get<std::uint64_t>() > 0)
        rows.push_back({escaped("answers that never came: " + message), latency.at("unanswered").dump()});
    }
  }
  out += rows.empty()
             ? "<p>Nothing: every frame came, whole and in order, and no error was seen on the bus.</p>\n"
             : table({"what", "how many"}, rows, "pairs");
  rows.clear();
  for (const Json& incident : report.at("bus").at("incidents"))
    rows.push_back(
        {fmt::format("{:.3f} s", incident.at("t_s").get<double>()), text_in(incident.at("event"))});
  if (!rows.empty()) out += table({"time", "event on the bus"}, rows, "pairs");
  return out + "</section>\n";
}

std::string provenance_section(const Json& report) {
  Rows rows;
  add_rows(rows, "", report.at("provenance"));
  add_rows(rows, "duration_s", report.at("duration_s"));
  add_rows(rows, "wall_s", report.at("wall_s"));
  add_rows(rows, "timing", report.at("timing"));
  return "<section id=\"provenance\"><h2>Provenance</h2>\n" + table({"what", "value"}, rows, "pairs") +
         "</section>\n";
}

}  // namespace canhil::report
