// Running the project's programs as a user does.
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

/// Bad input: exit code 2, one line on stderr that says `what`, nothing on stdout.
void expect_one_line(const Ended& ended, const std::string& what);

/// Outputs are judged on any host. What the clock of a shared machine did to timing is the verdict's
/// business, not a test's.
void expect_outputs_passed(const Ended& ended, const nlohmann::json& report);

}  // namespace canhil::test
