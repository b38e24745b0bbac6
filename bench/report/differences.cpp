#include "bench/report/differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "dbc/text/escape.hpp"
namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
// The values of a report by their paths.
struct Facts {
  std::map<std::string, std::string> values;
  std::vector<std::string> in_order;  // the paths, in the report's order

  // Several values with the same path, such as values of two adapters, are joined into one.
  void add(const std::string& path, const std::string& text) {
    const auto [known, is_new] = values.try_emplace(path, text);
    if (is_new)
      in_order.push_back(path);
    else
      known->second += ", " + text;
  }
};

struct Worded {
  std::string_view path, words;
};

// For each path, the words that replace it in the output. A path without an entry is shown unchanged, except
// that in_words() replaces the first part of some paths.
constexpr std::array<Worded, 29> worded{
    {{"dbc_hash", "DBC"},
     {"latency_stamps", "latency stamps"},
     {"period_overrides", "periods"},
     {"preemption", "preemption of the kernel"},
     {"cpu_model", "CPU"},
     {"target.program", "target"},
     {"target.version", "version of the target"},
     {"files.bench", "program of the bench (SHA-256)"},
     {"files.target", "program of the target (SHA-256)"},
     {"files.target argument", "file among the target's arguments (SHA-256)"},
     {"files.mapping", "mapping (SHA-256)"},
     {"files.recording", "recorded data (SHA-256)"},
     {"files.plant", "file of the plant (SHA-256)"},
     {"files.faults", "file of faults (SHA-256)"},
     {"adapters.kind", "adapter"},
     {"adapters.driver", "driver of the adapter"},
     {"adapters.address", "place of the adapter"},
     {"adapters.vendor_id", "vendor of the adapter"},
     {"adapters.product_id", "product of the adapter"},
     {"adapters.product", "name of the adapter"},
     {"adapters.serial", "serial number of the adapter"},
     {"adapters.usb_mbitps", "USB speed of the adapter [Mbit/s]"},
     {"bench_process.policy", "scheduling"},
     {"bench_process.locked_kib", "locked memory"},
     {"bench_process.timer_slack_ns", "timer slack [ns]"},
     {"bench_process.no_deep_sleep", "no deep sleep"},
     {"bench_process.spin_us", "spin [us]"},
     {"bitrate_bitps", "bit rate of the wire"},
     {"data_bitrate_bitps", "data bit rate of the wire"}}};

// Paths that are not compared here: their values must be equal for a comparison, or are compared under
// another path, or differ in every run. The kernel's preemption is already compared as `preemption`.
constexpr std::array<std::string_view, 10> left_out_of_it{
    "scenario",       "scenario_hash", "contract",  "clock",        "date",
    "files.scenario", "files.DBC",     "files.log", "adapters.bus", "bench_process.preemption"};

std::string in_words(const std::string& path) {
  const auto found = std::ranges::find(worded, path, &Worded::path);
  if (found != worded.end()) return std::string(found->words);
  constexpr std::array<Worded, 2> folders{{{"bus_of.", "bus of "}, {"bench_process.", "bench process "}}};
  for (const Worded& folder : folders) {
    if (path.starts_with(folder.path)) return std::string(folder.words) + path.substr(folder.path.size());
  }
  return path;
}

// A bus that the bench made for itself has the process id of the bench in its name, so the name differs in
// every run.
bool is_own_bus(std::string_view name) {
  constexpr std::string_view own = "local:canhil-";
  return name.starts_with(own) && name.size() > own.size() &&
         name.find_first_not_of("0123456789", own.size()) == std::string_view::npos;
}

std::string text_of(const std::string& path, const Json& value) {
  if (path == "bench_process.locked_kib" && value.is_number()) return value.get<double>() > 0 ? "yes" : "no";
  if (!value.is_string()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string text = value.get<std::string>();
  if (is_own_bus(text)) return "local:";
  return path.starts_with("files.") ? text.substr(0, 12) : text;
}

void add(Facts& facts, const std::string& path, const Json& value) {
  if (std::ranges::find(left_out_of_it, path) != left_out_of_it.end()) return;
  const bool objects = value.is_array() && !value.empty() && value.front().is_object();
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) add(facts, path.empty() ? key : path + "." + key, inner);
  } else if (!objects) {
    facts.add(path, text_of(path, value));
  } else {
    for (const Json& item : value) {
      const bool file = item.contains("role") && item.contains("sha256");
      if (file)
        add(facts, path + "." + item.at("role").get<std::string>(), item.at("sha256"));
      else
        add(facts, path, item);
    }
  }
}

Facts facts_of(const Json& report) {
  Facts all;
  add(all, "", report.at("provenance"));
  for (const char* key : {"bitrate_bitps", "data_bitrate_bitps"}) {
    if (report.contains("wire") && report.at("wire").contains(key)) add(all, key, report.at("wire").at(key));
  }
  return all;
}

std::vector<Facts> facts_of_each(const std::vector<Json>& reports) {
  std::vector<Facts> each;
  for (const Json& report : reports) each.push_back(facts_of(report));
  return each;
}

// The values of a side without duplicates, in the order of its runs.
std::vector<std::string> values_of(const std::vector<Facts>& side, const std::string& path) {
  std::vector<std::string> values;
  for (const Facts& facts : side) {
    const auto found = facts.values.find(path);
    const std::string text = found == facts.values.end() ? "not known" : found->second;
    if (std::ranges::find(values, text) == values.end()) values.push_back(text);
  }
  return values;
}

}  // namespace

std::string differences(const std::vector<Json>& before, const std::vector<Json>& after) {
  const std::vector<Facts> a = facts_of_each(before), b = facts_of_each(after);
  std::vector<std::string> paths;
  std::set<std::string> known;
  for (const std::vector<Facts>* side : {&a, &b}) {
    for (const Facts& facts : *side) {
      for (const std::string& path : facts.in_order) {
        if (known.insert(path).second) paths.push_back(path);
      }
    }
  }
  std::string lines;
  for (const std::string& path : paths) {
    const auto of_a = values_of(a, path), of_b = values_of(b, path);
    if (of_a != of_b)
      lines += one_line(fmt::format("differs  {}: {} -> {}", in_words(path), fmt::join(of_a, " and "),
                                    fmt::join(of_b, " and "))) +
               "\n";
  }
  return lines;
}

}  // namespace canhil::report
