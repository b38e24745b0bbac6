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
/// Parses JSON. This function is compiled once for all tests, because every source that instantiates a JSON
/// parser takes over a second longer to compile.
nlohmann::json json_of(const std::string& text);

/// The target's frames in a log, in order, from the first Sync on, without frames that report on the host or
/// the step.
std::vector<Frame> target_frames(const std::string& log_path);

/// True if the host did not disturb this run in real time: it completed, lost no frame, and the bench was
/// never late by 1 s or more. Only then can frames be counted and their bits be compared. A host that stalls
/// a program for half a second causes lost frames, a target that counts as silent, or idle heartbeats. If
/// false, the test repeats the run.
bool whole(const nlohmann::json& report);

/// The largest lateness of the bench itself; 0 in virtual time.
double largest_lateness_s(const nlohmann::json& report);

/// Runs hil-bench, at most four times, until the run that writes `report` is complete. Returns the last run.
/// A rejected configuration is not tried again.
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
