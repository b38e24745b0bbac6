#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/checks/bus_load.hpp"
#include "bench/report/run_sections.hpp"

namespace canhil::report {
namespace {

// Counts of events as rows of name and number, without counts that are 0.
void add_incidents(Rows& rows, const Json& object, std::string_view of) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_number() && value.get<double>() != 0)
      rows.push_back({escaped(fmt::format("{}: {}", of, key)), text_in(value)});
  }
}

// Each message's longest bus response time with its bound.
std::string wire_table(const Json& report) {
  if (!report.contains("wire")) return "";
  const Json& wire = report.at("wire");
  const canhil::wire::BitRates rates{.nominal = wire.at("bitrate_bitps").get<std::int64_t>(),
                                     .data = wire.value("data_bitrate_bitps", std::int64_t{0})};
  std::string out = fmt::format("<h3>Over the bus at {}, beside the bound</h3>\n", checks::to_text(rates));
  if (const auto why = wire.at("no_bounds").get<std::string>(); !why.empty())
    out += not_known(fmt::format("Bounds do not hold in this run: {}.", why));
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
         : beyond        ? outcome_words("fail", "beyond")
                         : fmt::format("{:.0f} %", longest_s / bound.get<double>() * 100)});
  }
  return out + table({"message", "count", "frame ms", "longest ms", "bound ms", "of it"}, rows, "figures");
}

// The id of the first plot with the limit of a check; empty: there is none.
std::string plot_of(const Json& check, const Json& all_series) {
  std::size_t number = 0;
  for (const Json& series : all_series) {
    const Json none = Json::array();
    for (const Json& bar : series.contains("bars") ? series.at("bars") : none) {
      if (bar.at("check") == check.at("name")) return series_id(number);
    }
    ++number;
  }
  return "";
}

// The signals of a frame in one line.
std::string signals_of(const Json& frame) {
  std::string signals;
  if (!frame.contains("signals")) return signals;
  for (const Json& signal : frame.at("signals")) {
    const std::string unit = text_in(signal.at(2));
    signals += fmt::format("{}{} {}{}{}", signals.empty() ? "" : ", ", text_in(signal.at(0)),
                           signal.at(1).is_null() ? "missing" : text_in(signal.at(1)),
                           unit.empty() ? "" : " ", unit);
  }
  return signals;
}

// The frames around the worst value of a check, folded; empty: the report has none.
std::string frames_of(const Json& check, const Json& report) {
  if (!check.contains("worst_at_s")) return "";
  const Json none = Json::array();
  const Json& all = report.contains("frames") ? report.at("frames") : none;
  const auto found =
      std::ranges::find_if(all, [&](const Json& one) { return one.at("check") == check.at("name"); });
  if (found == all.end() || found->at("frames").empty()) return "";
  const double worst_s = check.at("worst_at_s").get<double>();
  Rows rows;
  bool before = true;
  for (const Json& frame : found->at("frames")) {
    const double t_s = frame.at("t_s").get<double>();
    const std::string time = fmt::format("{:.6f}", t_s);
    const bool is_first = std::exchange(before, before && t_s < worst_s) && !before;
    rows.push_back({is_first ? fmt::format("<b>{}</b>", time) : time,
                    frame.at("transmitted").get<bool>() ? "sent" : "received",
                    fmt::format("{:0{}X}", frame.at("id").get<std::uint32_t>(),
                                frame.at("extended").get<bool>() ? 8 : 3),
                    frame.contains("error")     ? "error frame"
                    : frame.contains("message") ? text_in(frame.at("message"))
                                                : "?",
                    text_in(frame.at("bytes")), signals_of(frame)});
  }
  return folded(fmt::format("frames around {:g} s, when its worst value came", worst_s),
                table({"time s", "bench", "id", "message", "bytes", "signals"}, rows, "frames"));
}

}  // namespace

std::string series_id(std::size_t number) { return fmt::format("series-{}", number); }

std::string changes_section(const Json& report) {
  std::string out;
  if (report.contains("faults")) {
    Rows rows;
    for (const Json& fault : report.at("faults")) {
      std::string when;
      for (const Json& window : fault.at("windows"))
        when += fmt::format("{}{:g} to {:g}", when.empty() ? "" : "; ", window.at("from_s").get<double>(),
                            window.at("to_s").get<double>());
      const auto count = fault.at("count").get<std::uint64_t>();
      rows.push_back({text_in(fault.at("name")), text_in(fault.at("kind")), text_in(fault.at("stage")),
                      when.empty() ? "it never began" : when,
                      count == 0 ? "it did not strike" : fmt::format("{}", count)});
    }
    out += table({"fault", "kind", "where", "active, s", "struck, times"}, rows);
  }
  if (const Json& provenance = report.at("provenance"); provenance.contains("settings")) {
    Rows rows;
    for (const auto& [key, value] : provenance.at("settings").items())
      rows.push_back({escaped(key), text_in(value)});
    out += table({"key of the scenario", "set to"}, rows, "pairs");
  }
  if (const Json& bus = report.at("bus"); bus.contains("notes")) {
    std::string items;
    for (const Json& note : bus.at("notes")) items += fmt::format("<li>{}</li>\n", text_in(note));
    out += fmt::format("<ul>\n{}</ul>\n", items);
  }
  return out.empty() ? "" : section("changes", "Faults and changes", out);
}

std::string checks_section(const Json& report) {
  std::vector<Judged> all;
  for (const Json& check : report.at("checks")) {
    const auto text = [&check](const char* key) { return check.at(key).get<std::string>(); };
    all.push_back({.name = text("name"),
                   .outcome = text("outcome"),
                   .measured = text("measured"),
                   .expected = text("expected"),
                   .requirement = text("requirement"),
                   .link = plot_of(check, report.at("series")),
                   .more = frames_of(check, report)});
  }
  std::string out = judgements(all);
  const bool has_worst = std::ranges::any_of(report.at("checks"),
                                             [](const Json& check) { return check.contains("worst_at_s"); });
  if (has_worst && std::ranges::all_of(all, [](const Judged& one) { return one.more.empty(); }))
    out += not_known("The frames around the worst values are not kept: a run keeps frames only with --html.");
  return section("checks", "Checks", out);
}

std::string results_section(const Json& report) {
  if (!report.contains("results")) return "";
  std::string out;
  for (const auto& [estimator, lines] : report.at("results").items()) {
    Rows rows;
    for (const Json& line : lines) {
      std::string words;
      for (const Json& figure : line.at("figures")) {
        const std::string one = text_in(figure.at("words"));
        if (!one.empty()) words += (words.empty() ? "" : ", ") + one;
      }
      rows.push_back({text_in(line.at("what")), words.empty() ? "none" : words});
    }
    out += fmt::format("<h3>{}</h3>\n", escaped(estimator)) + table({"what", "value"}, rows, "pairs");
  }
  return section("results", "Results", out);
}

std::string estimates_section(const Json& report) {
  if (report.at("series").empty()) return "";
  std::string out, figures, estimator;
  const auto end_group = [&] {
    if (estimator.empty()) return;
    figures += flags(report.at("flags"), estimator, report.at("duration_s").get<double>());
    out += fmt::format("<h3>{}</h3>\n", escaped(estimator)) + grid(figures);
    figures.clear();
  };
  std::size_t number = 0;
  for (const Json& series : report.at("series")) {
    const std::string own = series.at("estimator").get<std::string>();
    if (own != estimator) end_group();
    estimator = own;
    figures += estimate(series, report, series_id(number++));
  }
  end_group();
  return section("estimates", "Estimates against the truth", out);
}

std::string bus_section(const Json& report) {
  const Json& load = report.at("bus_load_line");
  const double stretch_s = load.at("stretch_s").get<double>();
  const double data_bitrate = load.at("data_bitrate_bitps").get<double>();
  std::string out = grid(figure(
      fmt::format("Load at {:g} kbit/s{}", load.at("bitrate_bitps").get<double>() / 1e3,
                  data_bitrate > 0 ? fmt::format(", data {:g} kbit/s", data_bitrate / 1e3) : ""),
      from_zero("Bus load", "%", stretch_s, load.at("busiest"), 100),
      fmt::format(
          "by {:g} s, from the exact length of every frame; the last second is left out where it is not "
          "the only one: the run ends within it",
          stretch_s)));
  out += wire_table(report) + "<h3>Lost and broken</h3>\n";
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
  return section("bus", "Bus", out);
}

std::string provenance_section(const Json& report) {
  Json all = report.at("provenance");
  for (const char* key : {"duration_s", "wall_s", "timing"}) all[key] = report.at(key);
  return section("provenance", "Provenance", facts(all));
}

}  // namespace canhil::report
