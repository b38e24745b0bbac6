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

/// The bus that these tests run over: "local:", or what CANHIL_TEST_BUS says.
std::string bus();
std::string scenario(const std::string& name);
/// A file name in a folder of this test program alone.
std::string scratch(const std::string& name);
std::string read(const std::string& path);
nlohmann::json read_json(const std::string& path);
/// The value of a figure in the results of a report.
double figure(const nlohmann::json& report, const char* estimator, const char* line, const char* name);
/// Here for all: a parser costs each unit that makes one over a second.
nlohmann::json json_of(const std::string& text);

/// The target's frames in a log, in order, from the first Sync on, without those that speak of the host or of
/// the step.
std::vector<Frame> target_frames(const std::string& log_path);

/// A run in real time of which counts and bits can be asked: a host that keeps a program waiting for half a
/// second loses frames of vcan in its receive queue, or the target is silent for too long, or the bench is
/// away for so long that the target's process speaks up itself. The programs say so; such a run is flown
/// again.
bool whole(const nlohmann::json& report);

/// How late the bench itself was at the most; 0 in virtual time.
double largest_lateness_s(const nlohmann::json& report);

/// Runs hil-bench until the run whose report it is told to write to `report` is whole, four times at the
/// most; the last one. A configuration that is refused is not tried again.
Ended hil_bench_whole(const std::string& arguments, const std::string& report);

/// Bad input: exit code 2, one line on stderr that says `what`, nothing on stdout.
void expect_one_line(const Ended& ended, const std::string& what);

/// Why the outputs of a run did not all pass, in words; empty: they did. Outputs are judged on any host; what
/// a host that was late did to timing is the verdict's business, not a test's. So a check of timing may be
/// not measured; it may have failed where the bench itself was once late for its deadlines by more than half
/// of the check's bar: what held up the bench may hold up the target. Then alone may the verdict be 'fail'.
std::vector<std::string> output_complaints(const Ended& ended, const nlohmann::json& report);
void expect_outputs_passed(const Ended& ended, const nlohmann::json& report);

}  // namespace canhil::test
