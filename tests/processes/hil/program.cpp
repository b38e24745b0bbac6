#include "tests/processes/hil/program.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>

#include "dbc/logs/log.hpp"
#include "messages/canhil.hpp"
#include "tests/own_folder.hpp"

namespace canhil::test {

namespace {

/// The limit of a timing check, parsed from the report; empty if the check judges outputs, not timing.
std::optional<double> timing_bar_s(const nlohmann::json& check) {
  static const std::map<std::string, std::regex> bars{
      {"latency", std::regex(".* < ([0-9.]+) (ms) .*")},
      {"command", std::regex(".* < ([0-9.]+) (ms) .*")},
      {"output_period", std::regex(".* every ([0-9.]+) (ms) \\+- ([0-9.]+) %.*")},
      {"heartbeat", std::regex("never silent for more than ([0-9.]+) (s)")},
  };
  if (check["kind"] == "response") return 0.02;  // two steps of the plant: a late bench flies another loop
  if (check["kind"] == "event" && check.contains("upper")) return check["upper"].get<double>() * 1e-3;
  const auto bar = bars.find(check["kind"].get<std::string>());
  if (bar == bars.end()) return std::nullopt;
  std::smatch found;
  const auto expected = check["expected"].get<std::string>();
  if (!std::regex_match(expected, found, bar->second))
    return std::numeric_limits<double>::infinity();  // limit not found: no lateness excuses a failed check
  const double value = std::stod(found[1]) * (found[2] == "ms" ? 1e-3 : 1);
  return bar->first == "output_period" ? value * std::stod(found[3]) / 100 : value;
}

}  // namespace

double largest_lateness_s(const nlohmann::json& report) {
  return report.contains("bench_lateness_s") ? report["bench_lateness_s"]["max"].get<double>() : 0;
}

std::string scratch(const std::string& name) { return own_folder() + "/" + name; }

std::string read(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void edit(const std::string& path, const std::string& text, const std::string& instead) {
  std::string all = read(path);
  const auto at = all.find(text);
  ASSERT_NE(at, std::string::npos) << text;
  std::ofstream(path) << all.replace(at, text.size(), instead);
}

nlohmann::json json_of(const std::string& text) { return nlohmann::json::parse(text); }
nlohmann::json read_json(const std::string& path) { return json_of(read(path)); }

double figure(const nlohmann::json& report, const char* estimator, const char* line, const char* name) {
  const nlohmann::json::json_pointer place(
      fmt::format("/results/{}/{}/figures/{}/value", estimator, line, name));
  if (report.contains(place)) return report.at(place).get<double>();
  ADD_FAILURE() << "the report has no " << place.to_string();
  return std::nan("");
}

Ended shell(const std::string& command) {
  const std::string out = scratch("stdout");
  const std::string err = scratch("stderr");
  const int status = std::system(fmt::format("{{ {}\n}} >{} 2>{} </dev/null", command, out, err).c_str());
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = read(out), .err = read(err)};
}

Ended hil_bench(const std::string& arguments) { return shell(fmt::format("{} {}", HIL_BENCH, arguments)); }
Ended hil_target(const std::string& arguments) { return shell(fmt::format("{} {}", HIL_TARGET, arguments)); }

std::string without_capabilities(const std::string& dropped) {
  return geteuid() == 0 ? fmt::format("setpriv --bounding-set {} ", dropped) : "";
}

std::string bus() {
  const char* chosen = std::getenv("CANHIL_TEST_BUS");
  return chosen == nullptr ? "local:" : chosen;
}

std::string scenario(const std::string& name) {
  return fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name);
}

namespace {

// Calls `take(entry)` for each frame of a log.
template <class Take>
void each_entry(const std::string& log_path, const Take& take) {
  auto reader = LogReader::open(log_path);
  if (!reader) throw std::runtime_error(reader.error().message);
  for (;;) {
    const auto next = reader->next();
    if (!next) throw std::runtime_error(next.error().message);
    if (!*next) return;
    take(**next);
  }
}

bool of_target(const Frame& frame) {
  const MessageInfo* info = messages::find_message(frame.id);
  return info != nullptr && is_targets(*info);
}

// Silences before the first Sync do not count: during the handshake, the bench waits for the target.
double longest_silence_of_bench_s(const std::string& log_path) {
  std::optional<std::int64_t> last_ns;
  std::int64_t longest_ns = 0;
  each_entry(log_path, [&](const LogEntry& entry) {
    if (of_target(entry.frame) || (!last_ns && entry.frame.id != messages::Sync::info.id)) return;
    if (last_ns) longest_ns = std::max(longest_ns, entry.t_ns - *last_ns);
    last_ns = entry.t_ns;
  });
  return static_cast<double>(longest_ns) * 1e-9;
}

}  // namespace

std::vector<Frame> target_frames(const std::string& log_path) {
  std::vector<Frame> frames;
  bool synchronised = false;
  each_entry(log_path, [&](const LogEntry& entry) {
    const Frame& frame = entry.frame;
    synchronised = synchronised || frame.id == messages::Sync::info.id;
    if (!synchronised || !of_target(frame)) return;
    if (frame.id == messages::TargetTiming::info.id || frame.id == messages::StepDone::info.id) return;
    frames.push_back(frame);
  });
  return frames;
}

std::string disturbance(const RealTimeRun& run) {
  if (run.report["ending"]["completed"] != true) return run.report["ending"].dump();
  std::string found;
  const auto add = [&](const char* what, const char* place) {
    const int count = run.report.value(nlohmann::json::json_pointer(place), -1);  // -1: the count is missing
    if (count != 0) found += fmt::format("{} {}; ", what, count);
  };
  add("frames lost by the target:", "/target_counters/frames_lost");
  add("frames of the target lost:", "/from_target/frames_lost");
  add("overflows of the bench's queue:", "/from_target/bench_overflows");
  // A target that got no processor towards the end of the run answers after it.
  const nlohmann::json all = run.report.value("answers", nlohmann::json::object());
  for (const auto& [message, answers] : all.items()) {
    if (run.answers_all && answers["came"] < answers["due"])
      found +=
          fmt::format("{} of {} answers in {}; ", answers["came"].dump(), answers["due"].dump(), message);
  }
  if (const double silence_s = run.log.empty() ? 0 : longest_silence_of_bench_s(run.log); silence_s >= 1)
    found += fmt::format("the bench was silent for {:.3f} s; ", silence_s);
  return found;
}

std::string fly_undisturbed(const std::function<RealTimeRun()>& fly) {
  std::string found;
  for (int attempt = 1; attempt <= 4; ++attempt) {
    const RealTimeRun run = fly();
    const std::string what = run.report.is_null() ? "" : disturbance(run);
    if (what.empty()) return "";
    found += fmt::format("run {}: {}\n", attempt, what);
  }
  return found;
}

Ended hil_bench_whole(const std::string& arguments, const std::string& report) {
  Ended ended;
  fly_undisturbed([&] {
    ended = hil_bench(arguments);
    return RealTimeRun{.report = ended.code == 2 ? nlohmann::json() : read_json(report)};
  });
  return ended;
}

void expect_one_line(const Ended& ended, const std::string& what) {
  EXPECT_EQ(ended.code, 2) << ended.out << ended.err;
  EXPECT_THAT(ended.err, testing::HasSubstr(what));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(ended.out, "");
}

std::vector<std::string> output_complaints(const Ended& ended, const nlohmann::json& report) {
  std::vector<std::string> complaints;
  const auto complain = [&](bool fine, const std::string& what) {
    if (!fine) complaints.push_back(what);
  };
  complain(report["ending"]["completed"] == true, report["ending"].dump());
  int outputs = 0, excused = 0;
  for (const auto& check : report["checks"]) {
    const std::optional<double> bar_s = timing_bar_s(check);
    const bool failed = check["outcome"] == "fail";
    if (!bar_s) {
      complain(check["outcome"] == "pass", check.dump());
      ++outputs;
    } else if (check["kind"] == "event") {
      // The bench itself leaves the time of an answer unjudged when the host was busy; a wrong answer fails.
      complain(!failed, check.dump());
      if (check["outcome"] == "pass") ++outputs;
    } else if (failed) {
      const bool host_was_late = largest_lateness_s(report) > *bar_s / 2;
      complain(host_was_late, check.dump() + ": the host was not late");
      if (host_was_late) ++excused;
    } else if (check["kind"] == "response") {  // a late bench measures none
      const bool host_was_late = largest_lateness_s(report) > *bar_s / 4;
      if (check["outcome"] == "pass" || host_was_late) ++outputs;
    }
  }
  complain(outputs >= 5, fmt::format("{} checks of outputs, expected at least 5", outputs));
  const std::string verdict = report["verdict"];
  complain(verdict != "fail" || excused > 0, "the verdict is 'fail', and no check of timing is why");
  complain(ended.code == (verdict == "pass"   ? 0
                          : verdict == "fail" ? 1
                                              : 3),
           fmt::format("the verdict is '{}', the exit code {}", verdict, ended.code));
  return complaints;
}

void expect_outputs_passed(const Ended& ended, const nlohmann::json& report) {
  EXPECT_THAT(output_complaints(ended, report), testing::IsEmpty());
}

}  // namespace canhil::test
