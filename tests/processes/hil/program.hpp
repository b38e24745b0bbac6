// Starts the project's programs as a user does.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dbc/wire/frame.hpp"

namespace canhil::test {

struct Ended {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs a shell command to its end.
Ended shell(const std::string& command);
/// Runs hil-bench with arguments as typed.
Ended hil_bench(const std::string& arguments);
Ended hil_target(const std::string& arguments);

/// The bus of these tests: "local:", or the value of CANHIL_TEST_BUS.
std::string bus();
/// What to write before a command so that it runs without root's capabilities in `dropped`, for example
/// "-sys_nice,-ipc_lock". Empty if the caller is not root.
std::string without_capabilities(const std::string& dropped);
std::string scenario(const std::string& name);
/// A file name in a folder that only this test program uses.
std::string scratch(const std::string& name);
std::string read(const std::string& path);
nlohmann::json read_json(const std::string& path);
/// The value of a figure in the results of a report.
double figure(const nlohmann::json& report, const char* estimator, const char* line, const char* name);
/// Parses JSON. This function is compiled once for all tests, because every source that instantiates a JSON
/// parser takes over a second longer to compile.
nlohmann::json json_of(const std::string& text);

/// The target's frames in a log, in order, from the first Sync on, without frames that report on the host or
/// the step.
std::vector<Frame> target_frames(const std::string& log_path);

/// A run in real time.
struct RealTimeRun {
  nlohmann::json report;  // null: the configuration was rejected
  std::string log = {};   // path of the recording; needed if the target's bits are compared
};

/// What the host did to the run: it did not complete, or lost frames. With a recording also whether the bench
/// was silent for 1 s or more: a target that hears nothing for 2 s sends heartbeats of its own. Empty:
/// nothing; only then can frames be counted and their bits be compared. A bench that is late, but never
/// silent, changes neither.
std::string disturbance(const RealTimeRun& run);

/// Flies until the host disturbed no run, at most four times; a rejected configuration once. Returns the
/// disturbances of all runs if there is no other, otherwise an empty string.
std::string fly_undisturbed(const std::function<RealTimeRun()>& fly);

/// The largest lateness of the bench itself; 0 in virtual time.
double largest_lateness_s(const nlohmann::json& report);

/// fly_undisturbed() for hil-bench with arguments as typed, which writes `report`. Returns the last run.
Ended hil_bench_whole(const std::string& arguments, const std::string& report);

/// Bad input: exit code 2, one line on stderr that contains `what`, nothing on stdout.
void expect_one_line(const Ended& ended, const std::string& what);

/// Descriptions of the outputs that did not pass; empty: all passed. Outputs must pass on any host, but a
/// slow host may affect timing, which these tests do not judge. So a timing check may be not measured. It may
/// also fail if the bench missed one of its own deadlines by more than half of the check's limit, because the
/// host may have delayed the target as much. Only in that case may the verdict be 'fail'.
std::vector<std::string> output_complaints(const Ended& ended, const nlohmann::json& report);
void expect_outputs_passed(const Ended& ended, const nlohmann::json& report);

}  // namespace canhil::test
