// Functions that start the project's programs as a user does.
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
/// Runs hil-bench; `arguments` is what a user types after the program's name.
Ended hil_bench(const std::string& arguments);
Ended hil_target(const std::string& arguments);

/// The bus of these tests: "local:", or the value of the environment variable CANHIL_TEST_BUS.
std::string bus();
/// A prefix for a shell command. The command with the prefix runs without the capabilities of root that
/// `dropped` lists, for example "-sys_nice,-ipc_lock". The prefix is empty if the caller is not root.
std::string without_capabilities(const std::string& dropped);
std::string scenario(const std::string& name);
/// The path of the file `name` in a temporary folder that only this process uses.
std::string scratch(const std::string& name);
std::string read(const std::string& path);
/// Replaces a text in a file, which must contain it.
void edit(const std::string& path, const std::string& text, const std::string& instead);
nlohmann::json read_json(const std::string& path);
/// The value of a figure in a report: the figure `name` in the line `line` of the results of `estimator`.
double figure(const nlohmann::json& report, const char* estimator, const char* line, const char* name);
/// Parses JSON. This function is compiled once for all tests, because every source that instantiates a JSON
/// parser takes over a second longer to compile.
nlohmann::json json_of(const std::string& text);

/// The frames that the target sent after the first Sync in a log, in the order of the log. Leaves out
/// TargetTiming, which depends on the host, and StepDone, which only lockstep has.
std::vector<Frame> target_frames(const std::string& log_path);

/// A run in real time.
struct RealTimeRun {
  nlohmann::json report;    // null: the configuration was rejected
  std::string log = {};     // path of the recording; needed if the target's bits are compared
  bool answers_all = true;  // an answer that does not come is a disturbance
};

/// Describes how the host disturbed a run: the run did not complete, frames were lost, or answers did not
/// come. If there is a recording, a silence of the bench of 1 s or more is a disturbance too, because a
/// target that receives nothing for 2 s sends additional heartbeats. The text is empty if nothing disturbed
/// the run; only then can tests count frames and compare their bits. A bench that is late, but not silent for
/// so long, does not change the frames.
std::string disturbance(const RealTimeRun& run);

/// Calls `fly` until a run is undisturbed or its configuration is rejected, but at most four times. Returns
/// an empty string if the last run was undisturbed or rejected. If all four runs were disturbed, returns the
/// disturbances of all of them.
std::string fly_undisturbed(const std::function<RealTimeRun()>& fly);

/// The largest lateness of the bench itself; 0 in virtual time.
double largest_lateness_s(const nlohmann::json& report);

/// Calls hil_bench(arguments) again and again, as fly_undisturbed() does, until a run is undisturbed. The
/// arguments must make hil-bench write the file `report`. Returns the result of the last call.
Ended hil_bench_whole(const std::string& arguments, const std::string& report);

/// Expects that a program rejected bad input: exit code 2, one line on stderr that contains `what`, an empty
/// stdout.
void expect_one_line(const Ended& ended, const std::string& what);

/// Describes the outputs that did not pass; empty if all passed. Outputs must pass on any host. Timing is not
/// judged here, because a slow host may affect it. So the outcome of a timing check may be 'not measured'. A
/// timing check may also fail if the bench missed one of its own deadlines by more than half of the check's
/// limit, because the host may have delayed the target as much. Only in that case may the verdict be 'fail'.
std::vector<std::string> output_complaints(const Ended& ended, const nlohmann::json& report);
void expect_outputs_passed(const Ended& ended, const nlohmann::json& report);

}  // namespace canhil::test
