#include "bench/live/message.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/report/rounded.hpp"

namespace canhil::live {
namespace {

using Json = nlohmann::ordered_json;
using report::rounded;

Json json_number(double value, int digits = 5) {
  return std::isfinite(value) ? Json(rounded(value, digits)) : Json(nullptr);
}
Json json_number(const std::optional<double>& value) { return value ? json_number(*value) : Json(nullptr); }
Json outcome(const std::optional<checks::Outcome>& outcome) {
  return outcome ? Json(checks::name(*outcome)) : Json(nullptr);
}

std::string key_of(const report::Series& series) { return series.estimator + '/' + series.quantity; }

// A series with its points from index `from` on. These include the last point that was sent, because it may
// have changed since.
Json object(const report::Series& series, std::size_t from) {
  constexpr std::array<std::string_view, 4> kinds{"estimate", "error", "innovation", "statistic"};
  Json json{{"key", key_of(series)},
            {"estimator", series.estimator},
            {"name", series.name},
            {"title", series.quantity},
            {"unit", series.unit},
            {"kind", kinds[static_cast<std::size_t>(series.kind)]},
            {"from", from},
            {"t_s", Json::array()},
            {"low", Json::array()},
            {"high", Json::array()},
            {"sigma", Json::array()},
            {"bars", Json::array()},
            {"between", series.between}};
  for (std::size_t i = from; i < series.points.size(); ++i) {
    const report::Series::Point& point = series.points[i];
    json["t_s"].push_back(point.t_s);
    json["low"].push_back(json_number(point.low));
    json["high"].push_back(json_number(point.high));
    json["sigma"].push_back(json_number(point.sigma));
  }
  for (const report::Series::Bar& bar : series.bars)
    json["bars"].push_back({{"check", bar.check},
                            {"below", json_number(bar.below)},
                            {"from_s", bar.from_s},
                            {"to_s", bar.to_s}});
  return json;
}

Json object(const TimingLine& line) {
  Json json{{"message", line.message},
            {"count", line.count},
            {"p50_us", json_number(line.p50_us)},
            {"p99_us", json_number(line.p99_us)},
            {"max_us", json_number(line.max_us)},
            {"jitter_count", line.jitter_count},
            {"jitter_p99_us", json_number(line.jitter_p99_us)},
            {"jitter_max_us", json_number(line.jitter_max_us)}};
  if (line.slowest_us.empty()) return json;
  json["stretch_s"] = line.stretch_s;
  for (const double slowest_us : line.slowest_us) json["slowest_us"].push_back(json_number(slowest_us));
  return json;
}

template <class FromOf>
Json object(const Flight& flight, FromOf from_of) {
  Json json{{"title", flight.title},
            {"scenario", flight.scenario},
            {"bus", flight.bus},
            {"clock", flight.clock},
            {"t_s", flight.t_s},
            {"duration_s", flight.duration_s},
            {"outcome", outcome(flight.outcome)},
            {"reason", flight.reason},
            {"checks", Json::array()},
            {"series", Json::array()},
            {"no_timing", flight.no_timing},
            {"no_tracks", flight.no_tracks},
            {"timing", Json::array()},
            {"bit_rate", flight.bit_rate},
            {"load_now", json_number(flight.load_now)},
            {"load_mean", json_number(flight.load.mean)},
            {"load_busiest", json_number(flight.load.busiest)},
            {"load_stretch_s", flight.load_line.stretch_s},
            {"load", Json::array()},
            {"faults", Json::array()}};
  for (const CheckLine& check : flight.checks)
    json["checks"].push_back({{"name", check.name},
                              {"outcome", outcome(check.outcome)},
                              {"measured", check.measured},
                              {"expected", check.expected}});
  for (const report::Series& series : flight.series)
    json["series"].push_back(object(series, from_of(series)));
  for (const TimingLine& line : flight.timing) json["timing"].push_back(object(line));
  for (const double busiest : flight.load_line.busiest) json["load"].push_back(json_number(busiest));
  for (const FaultLine& fault : flight.faults)
    json["faults"].push_back({{"name", fault.name},
                              {"kind", fault.kind},
                              {"stage", fault.stage},
                              {"from_s", fault.from_s},
                              {"to_s", fault.to_s},
                              {"begins_in_run", fault.begins_in_run}});
  return json;
}

Json object(const Batch& batch) {
  Json json{{"title", batch.title},
            {"of", batch.of},
            {"done", batch.done},
            {"total", batch.total},
            {"failed", batch.failed},
            {"failed_means", batch.failed_means},
            {"rate_per_s", json_number(batch.rate_per_s)},
            {"outcome", outcome(batch.outcome)},
            {"reason", batch.reason},
            {"latest", Json::array()}};
  for (const Batch::Line& line : batch.latest)
    json["latest"].push_back({{"name", line.name}, {"result", line.result}, {"failed", line.failed}});
  return json;
}

template <class FromOf>
std::string message(const Snapshot& snapshot, FromOf from_of) {
  Json json{{"ended", snapshot.ended},
            {"over", snapshot.over()},
            {"frames", snapshot.frames},
            {"dropped", snapshot.dropped}};
  if (snapshot.flight) json["flight"] = object(*snapshot.flight, from_of);
  if (snapshot.batch) json["batch"] = object(*snapshot.batch);
  // Names of files and buses may contain bytes that are not UTF-8; such bytes are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string whole_message(const Snapshot& snapshot) {
  return message(snapshot, [](const report::Series&) { return std::size_t{0}; });
}

std::string next_message(const Snapshot& snapshot, Sent& sent) {
  return message(snapshot, [&](const report::Series& series) {
    std::size_t& before = sent[key_of(series)];
    const std::size_t from = snapshot.over() || before == 0 ? 0 : before - 1;
    before = series.points.size();
    return from;
  });
}

}  // namespace canhil::live
