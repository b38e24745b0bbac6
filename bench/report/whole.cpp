#include "bench/report/whole.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

// An error in the report. It is thrown, so the first error ends the check.
struct Wrong {
  std::string what;
};

// A value and its path.
struct At {
  const Json& value;
  std::string path;

  [[noreturn]] void expected(std::string_view what) const {
    constexpr std::size_t most = 60;
    std::string is = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (is.size() > most) is = is.substr(0, most) + "...";
    throw Wrong{fmt::format("key '{}': is {}, expected {}", path, is, what)};
  }
  [[nodiscard]] bool has(const std::string& key) const { return value.contains(key); }
  [[nodiscard]] At operator[](const std::string& key) const {
    if (!value.is_object()) expected("a table");
    const std::string inner = path.empty() ? key : path + "." + key;
    const auto found = value.find(key);
    if (found == value.end()) throw Wrong{fmt::format("key '{}' is missing, expected a whole report", inner)};
    return {*found, inner};
  }
  template <class Look>
  void each(Look look) const {
    if (!value.is_array()) expected("a list");
    for (std::size_t i = 0; i < value.size(); ++i) look(At{value[i], fmt::format("{}[{}]", path, i)});
  }
  template <class Look>
  void each_key(Look look) const {
    if (!value.is_object()) expected("a table");
    for (const auto& [key, inner] : value.items()) look(At{inner, path + "." + key});
  }
};

void text(const At& at) {
  if (!at.value.is_string()) at.expected("text");
}
void flag(const At& at) {
  if (!at.value.is_boolean()) at.expected("true or false");
}
double number(const At& at) {
  if (!at.value.is_number() || !std::isfinite(at.value.get<double>())) at.expected("a number");
  return at.value.get<double>();
}
std::uint64_t count(const At& at) {
  constexpr std::string_view expected = "a whole number of at least 0";
  if (!at.value.is_number_integer()) at.expected(expected);
  if (!at.value.is_number_unsigned() && at.value.get<std::int64_t>() < 0) at.expected(expected);
  return at.value.get<std::uint64_t>();
}

// Checks the buckets of a histogram, which have the form [[from us, count], ...]. The buckets must be in
// ascending order, and their counts must add up to `counted`.
void buckets(const At& at, std::uint64_t counted) {
  constexpr std::uint64_t last_us = 10'000'000;  // the last bucket holds all larger values
  std::uint64_t next_us = 0, left = counted;
  at.each([&](const At& bucket) {
    if (!bucket.value.is_array() || bucket.value.size() != 2) bucket.expected("[from us, count]");
    bucket.each([](const At& item) { count(item); });
    const auto from_us = bucket.value[0].get<std::uint64_t>(), inside = bucket.value[1].get<std::uint64_t>();
    if (from_us < next_us || from_us > last_us)
      bucket.expected(fmt::format("a bucket from {} to {} us, in ascending order", next_us, last_us));
    if (inside > left) bucket.expected(fmt::format("no more than the {} of 'count' in all", counted));
    next_us = from_us + 1;
    left -= inside;
  });
  if (left > 0)
    throw Wrong{fmt::format("key '{}' holds {} of {}, expected as many as 'count'", at.path, counted - left,
                            counted)};
}

void distribution(const At& at) {
  double least = -std::numeric_limits<double>::infinity();
  const std::uint64_t counted = count(at["count"]);
  for (const char* key : {"min", "p50", "p90", "p99", "p999", "max"}) {
    const At one = at[key];
    if (number(one) < least) one.expected(fmt::format("at least {:g}, as the one before it", least));
    least = number(one);
  }
  buckets(at["buckets_us"], counted);
}

// In virtual time there are no distributions.
void timing(const At& report) {
  flag(report["timing"]["judged"]);
  text(report["timing"]["why_not"]);
  if (report.has("latency_s")) {
    report["latency_s"].each_key([](const At& message) {
      distribution(message);
      flag(message["closes_group"]);
      count(message["unanswered"]);
    });
  }
  if (report.has("jitter_s")) report["jitter_s"].each_key(distribution);
  if (report.has("transmit_lateness_s")) {
    report["transmit_lateness_s"].each_key([](const At& message) {
      distribution(message["handed_over"]);
      if (message.has("echoed")) distribution(message["echoed"]);
    });
  }
  if (report.has("bench_lateness_s")) distribution(report["bench_lateness_s"]);
  if (report.has("split") && report["split"].has("slowest")) {
    for (const char* key : {"queue_max_us", "compute_max_us"}) count(report["split"]["slowest"][key]);
  }
  if (report.has("uncertainty")) {
    report["uncertainty"]["latency_s"].each_key([](const At& message) {
      message.each_key([](const At& figure) {
        number(figure["value"]);
        number(figure["expanded"]);
        figure["half_widths"].each_key([](const At& half_width) { number(half_width); });
      });
    });
    report["uncertainty"]["left_out"].each([](const At& what) { text(what); });
  }
  if (report.has("wire")) {
    const At wire = report["wire"];
    count(wire["bitrate_bitps"]);
    if (wire.has("data_bitrate_bitps")) count(wire["data_bitrate_bitps"]);
  }
}

// Its numbers are optional; a limit has all its parts.
void one_check(const At& check) {
  for (const char* key : {"name", "kind", "outcome", "measured", "expected"}) text(check[key]);
  for (const char* key : {"quantity", "estimator", "statistic", "unit", "while"}) {
    if (check.has(key)) text(check[key]);
  }
  for (const char* key : {"value", "margin", "from_s", "to_s", "worst_at_s"}) {
    if (check.has(key)) number(check[key]);
  }
  for (const std::string key : {"lower", "upper"}) {
    if (!check.has(key)) continue;
    number(check[key]);
    flag(check[key + "_inclusive"]);
    text(check["unit"]);
  }
  if (check.has("count")) count(check["count"]);
  if (check.has("time_to_go_s")) {
    const At ends = check["time_to_go_s"];
    if (!ends.value.is_array() || ends.value.size() != 2) ends.expected("[least, most]");
    ends.each([](const At& end) { number(end); });
  }
}

void one_frame(const At& frame) {
  number(frame["t_s"]);
  for (const char* key : {"transmitted", "extended"}) flag(frame[key]);
  if (count(frame["id"]) > std::numeric_limits<std::uint32_t>::max()) frame["id"].expected("an id of CAN");
  text(frame["bytes"]);
  if (frame.has("message")) text(frame["message"]);
  if (!frame.has("signals")) return;
  frame["signals"].each([](const At& signal) {
    const Json& parts = signal.value;
    if (!parts.is_array() || parts.size() != 3 || !parts[0].is_string() ||
        !(parts[1].is_null() || parts[1].is_number()) || !parts[2].is_string())
      signal.expected("[name, value, unit]");
  });
}

}  // namespace

std::string why_not_whole(const Json& report) {
  try {
    const At all{report, ""};
    for (const char* key : {"title", "verdict", "reason"}) text(all[key]);
    number(all["duration_s"]);
    for (const char* key : {"scenario", "scenario_hash", "contract", "bus", "clock", "date"})
      text(all["provenance"][key]);
    all["checks"].each(one_check);
    if (all.has("results")) {
      all["results"].each_key([](const At& estimator) {
        estimator.each_key([](const At& line) {
          text(line["what"]);
          line["figures"].each_key([](const At& figure) { text(figure["words"]); });
        });
      });
    }
    timing(all);
    all["series"].each([](const At& series) {
      for (const char* key : {"estimator", "quantity", "unit", "kind"}) text(series[key]);
    });
    if (all.has("frames")) {
      all["frames"].each([](const At& around) {
        text(around["check"]);
        around["frames"].each(one_frame);
      });
    }
  } catch (const Wrong& wrong) {
    return wrong.what;
  }
  return {};
}

}  // namespace canhil::report
