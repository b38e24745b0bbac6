#include "bench/report/run_reports.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "bench/checks/answered.hpp"
#include "bench/checks/bus_load.hpp"
#include "bench/checks/result_json.hpp"
#include "bench/report/flags.hpp"
#include "bench/report/frames_around.hpp"
#include "bench/report/json_timing.hpp"
#include "bench/report/provenance.hpp"
#include "bench/report/rounded.hpp"
#include "bench/report/series.hpp"
#include "bench/report/summary.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/realtime/host.hpp"
#include "dbc/version/version.hpp"

namespace canhil::report {
namespace {

Json object(const std::vector<estimators::ResultLine>& lines) {
  Json json = Json::object();
  for (const estimators::ResultLine& line : lines) {
    Json figures = Json::object();
    for (const estimators::Figure& figure : line.figures) {
      const auto count = static_cast<std::int64_t>(figure.value.value_or(0.5));
      const bool whole = figure.value && static_cast<double>(count) == *figure.value;
      figures[figure.name] = {{"value", !figure.value ? Json(nullptr)
                                        : whole       ? Json(count)
                                                      : Json(*figure.value)},
                              {"words", figure.text}};
    }
    json[line.name] = {{"what", line.what}, {"figures", std::move(figures)}};
  }
  return json;
}

Json object(const checks::BusRecord& bus, std::int64_t first_ns) {
  const BusErrors& errors = bus.errors;
  Json json{{"error_frames", errors.frames},
            {"bus_off", errors.bus_off},
            {"restarted", errors.restarted},
            {"error_passive", errors.passive},
            {"error_warning", errors.warning},
            {"error_active", errors.active},
            {"no_ack", errors.no_ack},
            {"lost_arbitration", errors.lost_arbitration},
            {"tx_timeout", errors.tx_timeout},
            {"protocol", errors.protocol},
            {"bus_error", errors.bus_error},
            {"controller_rx_overflow", errors.rx_overflow},
            {"controller_tx_overflow", errors.tx_overflow},
            {"transceiver", errors.transceiver},
            {"tx_counter_max", errors.tx_counter_max},
            {"rx_counter_max", errors.rx_counter_max},
            {"interface_down", bus.downs},
            {"late_in_queue", bus.late_in_queue},
            {"foreign_frames", bus.foreign},
            {"incidents", Json::array()},
            {"more_incidents", bus.more_incidents}};
  if (!bus.notes.empty()) json["notes"] = bus.notes;
  for (const checks::BusIncident& incident : bus.incidents) {
    json["incidents"].push_back({{"t_s", static_cast<double>(incident.t_ns - first_ns) * 1e-9},
                                 {"event", name(incident.event)},
                                 {"tx_counter", incident.tx_counter},
                                 {"rx_counter", incident.rx_counter}});
  }
  return json;
}

Json object(const realtime::Standing& host, std::int64_t spin_ns) {
  return {{"policy", host.policy},
          {"priority", host.priority},
          {"cpus", host.cpus},
          {"locked_kib", host.locked_kib},
          {"timer_slack_ns", host.timer_slack_ns},
          {"no_deep_sleep", host.awake},
          {"governors", host.governors},
          {"preemption", host.preemption},
          {"spin_us", spin_ns / 1000}};
}

// Indexed by Series::Kind.
constexpr std::array<std::string_view, 4> kind_names{"estimate", "error", "innovation", "statistic"};

constexpr std::size_t most_changes = 1000;  // of a flag

Json object(const Series& series) {
  Json json{{"estimator", series.estimator},
            {"name", series.name},
            {"quantity", series.quantity},
            {"unit", series.unit},
            {"kind", kind_names[static_cast<std::size_t>(series.kind)]},
            {"t_s", Json::array()},
            {"low", Json::array()},
            {"high", Json::array()}};
  // An estimate needs more digits, because it differs from the truth only in the last digits.
  const int digits = series.kind == Series::Kind::estimate ? 8 : 5;
  const auto or_null = [&](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(rounded(*value, digits)) : Json(nullptr);
  };
  for (const Series::Point& point : series.points) {
    json["t_s"].push_back(point.t_s);
    json["low"].push_back(or_null(point.low));
    json["high"].push_back(or_null(point.high));
    if (series.kind == Series::Kind::error) json["sigma"].push_back(or_null(point.sigma));
    if (series.kind == Series::Kind::estimate) json["truth"].push_back(or_null(point.truth));
  }
  for (const Series::Bar& bar : series.bars) {
    json["bars"].push_back({{"check", bar.check},
                            {"statistic", bar.statistic},
                            {"below", rounded(bar.below)},
                            {"from_s", bar.from_s},
                            {"to_s", bar.to_s}});
  }
  if (!series.between.empty()) json["between_95_percent"] = series.between;
  return json;
}

// The bus load of each second. In a long run, several seconds are joined to a stretch, and the maximum of
// each stretch is given.
Json load_line(const checks::Observations& seen, const wire::BitRates& rates) {
  const checks::LoadLine line = checks::load_line(checks::whole_seconds(seen), rates);
  Json json{{"bitrate_bitps", rates.nominal},
            {"data_bitrate_bitps", rates.data},
            {"stretch_s", line.stretch_s},
            {"busiest", Json::array()}};
  for (const double busiest : line.busiest) json["busiest"].push_back(rounded(busiest));
  return json;
}

// The tested program and its version, if known. The program's file is among the files of the run.
Json target(const drive::Run& run) {
  Json json{{"program", target_program(run)}};
  if (!run.seen.target_version.empty()) json["version"] = run.seen.target_version;
  return json;
}

Json object(const drive::RunFile& file) {
  Json json{{"role", file.role}, {"name", file.name}, {"sha256", file.identity.sha256}};
  if (file.identity.modified_s != 0) {
    json["bytes"] = file.identity.bytes;
    json["date"] = date_utc(file.identity.modified_s);
  }
  return json;
}

Json object(const drive::Adapter& adapter) {
  Json json{{"bus", adapter.bus}, {"kind", adapter.kind}};
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) json[key] = value;
  };
  add("driver", adapter.driver);
  add("address", adapter.address);
  add("vendor_id", adapter.vendor_id);
  add("product_id", adapter.product_id);
  add("product", adapter.product);
  add("serial", adapter.serial);
  if (adapter.usb_mbitps > 0) json["usb_mbitps"] = adapter.usb_mbitps;
  return json;
}

Json provenance(const scenario::Scenario& scenario, const drive::Run& run) {
  const scenario::Binding& binding = *scenario.binding;
  Json json{
      {"scenario", scenario.file},
      {"scenario_hash", fmt::format("{:016x}", scenario.hash)},
      {"contract", binding.files.empty() ? std::string(name_of(run.options.format)) : to_text(binding.files)},
      {"dbc_hash", fmt::format("{:016x}", binding.dbc_hash)},
      {"seed", scenario.seed},
      {"run", run.options.run_index},
      {"bus", run.options.bus.text},
      {"clock", clock_name(run)},
      {"latency_stamps", stamp_source(run)},
      {"period_overrides", period_overrides(scenario)},
      {"date", date_utc(run.started_s)},
      {"version", version_text()},
      {"revision", revision()},
      {"host", host_name()},
      {"kernel", kernel()},
      {"preemption", realtime::preemption()},
      {"cpu_model", cpu_model()},
      {"target", target(run)}};
  if (!run.options.operator_name.empty()) json["operator"] = run.options.operator_name;
  for (const scenario::Setting& one : scenario.settings) json["settings"][one.key] = one.value;
  for (const auto& [node, bus] : run.options.bus_of) json["bus_of"][node] = bus;
  for (const drive::Adapter& adapter : run.adapters) json["adapters"].push_back(object(adapter));
  for (const drive::RunFile& file : run.files) json["files"].push_back(object(file));
  if (run.host) json["bench_process"] = object(*run.host, run.options.spin_ns);
  return json;
}

void print(std::string& out, const Json& json, std::size_t indent) {
  // File and bus names need not be UTF-8.
  const auto plain = [](const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  const bool open =
      (json.is_object() && !json.empty()) ||
      (json.is_array() && std::ranges::any_of(json, [](const Json& j) { return j.is_object(); }));
  if (!open) {
    out += plain(json);
    return;
  }
  out += json.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    out += (first ? "\n" : ",\n") + std::string(indent + 2, ' ');
    if (json.is_object()) out += plain(Json(key)) + ": ";
    print(out, value, indent + 2);
    first = false;
  }
  out += "\n" + std::string(indent, ' ') + (json.is_object() ? "}" : "]");
}

}  // namespace

Json document(const scenario::Scenario& scenario, const drive::Run& run) {
  Json page;
  page["schema"] = schema;
  page["title"] = scenario.title;
  page["verdict"] = checks::name(run.verdict.outcome);
  page["reason"] = run.verdict.reason;
  page["provenance"] = provenance(scenario, run);
  page["duration_s"] = static_cast<double>(scenario.duration_us) / 1e6;
  page["wall_s"] = run.wall_s;
  page["ending"] = {{"completed", run.ending.kind == drive::Ending::Kind::completed},
                    {"t_s", static_cast<double>(run.ending.t_us) / 1e6},
                    {"detail", run.ending.detail}};
  for (const faults::FaultReport& fault : run.faults) {
    Json one{{"name", fault.name},
             {"kind", fault.kind},
             {"stage", faults::name(fault.stage)},
             {"count", fault.count},
             {"windows", Json::array()}};
    for (const faults::Trigger& window : fault.windows)
      one["windows"].push_back({{"from_s", static_cast<double>(window.from_us) / 1e6},
                                {"to_s", static_cast<double>(window.to_us) / 1e6}});
    page["faults"].push_back(std::move(one));
  }
  page["checks"] = Json::array();
  for (const checks::CheckResult& check : run.verdict.checks) page["checks"].push_back(json_of(check));
  for (const EstimatorResults& one : results(scenario, run))
    page["results"][std::string(one.estimator)] = object(one.lines);
  page["timing"] = timing_judged(run);
  if (run.clock != drive::ClockKind::lockstep) add_timing(page, scenario, run);
  if (run.seen.target_timing_seen)
    page["target_timing_us"] = {{"queue_max", run.seen.queue_max_us},
                                {"compute_max", run.seen.compute_max_us}};
  for (const std::string_view message : closing_answers(scenario)) {
    const checks::Answered answers =
        checks::answered(run.seen, message, {.from_us = 0, .to_us = scenario.duration_us});
    if (answers.due > 0)
      page["answers"][std::string(message)] = {{"due", answers.due}, {"came", answers.came}};
  }
  const checks::TargetReports& reports = run.seen.reports;
  if (reports.heartbeats() > 0) {
    Json& heartbeat =
        page["target_heartbeat"] = {{"count", reports.heartbeats()}, {"reports", Json::array()}};
    for (const checks::Report& one : reports.reports())
      heartbeat["reports"].push_back({{"estimator", one.estimator},
                                      {"what", one.what},
                                      {"from_s", static_cast<double>(one.t_us) / 1e6}});
  }
  if (run.seen.counters) {
    page["target_counters"] = {{"frames_lost", run.seen.counters->frames_lost},
                               {"bad_crc", run.seen.counters->bad_crc},
                               {"bad_group", run.seen.counters->bad_group},
                               {"late", run.seen.counters->late}};
  }
  for (const wire::BitRates& rates : load_rates(run)) {
    const checks::Load load = checks::bus_load(run.seen, rates);
    page["bus_load"].push_back({{"bitrate_bitps", rates.nominal},
                                {"data_bitrate_bitps", rates.data},
                                {"mean", load.mean},
                                {"busiest_second", load.busiest}});
  }
  page["from_target"] = {{"frames_lost", run.seen.lost_from_target()},
                         {"bad_crc", run.seen.spoilt_from_target()},
                         {"bench_overflows", run.seen.receive_overflows}};
  page["bus"] = object(run.seen.bus, run.seen.first_ns);
  page["bus_load_line"] = load_line(run.seen, load_rates(run)[0]);
  page["series"] = Json::array();
  for (const Series& one : series(scenario, run)) page["series"].push_back(object(one));
  page["flags"] = Json::array();
  give_flags(scenario, run, [&](std::string_view estimator, std::string_view flag, const auto& changes) {
    Json shown = Json::array();
    for (std::size_t i = 0; i < std::min(changes.size(), most_changes); ++i)
      shown.push_back({static_cast<double>(changes[i].first) * 1e-6, changes[i].second});
    page["flags"].push_back({{"estimator", estimator},
                             {"name", flag},
                             {"change_count", changes.size()},
                             {"changes", std::move(shown)}});
  });
  if (run.frames) page["frames"] = frames_around_worst(scenario, run);
  return page;
}

std::string json(const scenario::Scenario& scenario, const drive::Run& run) {
  std::string out;
  print(out, document(scenario, run), 0);
  return out + "\n";
}

}  // namespace canhil::report
