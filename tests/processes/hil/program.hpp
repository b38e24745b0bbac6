// Starts the project's programs as a user does.
#pragma once

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
std::string scenario(const std::string& name);
/// A file name in a folder that only this test program uses.
std::string scratch(const std::string& name);
std::string read(const std::string& path);
nlohmann::json read_json(const std::string& path);
/// The value of a figure in the results of a report.
double figure(const nlohmann::json& report, const char* estimator, const char* line, const char* name);
/// Compiled once for all tests, because a JSON parser costs every source that instantiates it over a second.
nlohmann::json json_of(const std::string& text);

/// The target's frames in a log, in order, from the first Sync on, without the frames that report on the host
/// or the step.
std::vector<Frame> target_frames(const std::string& log_path);

/// A run in real time whose counts and bits can be tested. If the host stalls a program for half a second,
/// vcan's receive queue loses frames, or the target is silent for too long, or the target's process sends
/// heartbeats of its own. The programs report this, and the run is repeated.
bool whole(const nlohmann::json& report);

/// The largest lateness of the bench itself; 0 in virtual time.
double largest_lateness_s(const nlohmann::json& report);

/// Runs hil-bench, at most four times, until the run that writes `report` is complete. Returns the last run.
/// A rejected configuration is not tried again.
Ended hil_bench_whole(const std::string& arguments, const std::string& report);

/// Bad input: exit code 2, one line on stderr that contains `what`, nothing on stdout.
void expect_one_line(const Ended& ended, const std::string& what);

/// The outputs that did not pass, in words; empty: all passed. Outputs must pass on any host, but a slow host
/// may affect timing, which this does not test. So a timing check may be not measured. It may also have
/// failed if the bench missed a deadline of its own by more than half of the check's bar, because the host
/// may have delayed the target as much. Only in that case may the verdict be 'fail'.
std::vector<std::string> output_complaints(const Ended& ended, const nlohmann::json& report);
void expect_outputs_passed(const Ended& ended, const nlohmann::json& report);

}  // namespace canhil::test
