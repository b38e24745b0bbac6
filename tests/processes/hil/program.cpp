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
#include <stdexcept>

#include "dbc/ports/candump_log.hpp"
#include "messages/canhil.hpp"

namespace canhil::test {

namespace {

/// The folder of this program. It stays where a test failed: somebody will want to look.
class Folder {
 public:
  Folder() { std::filesystem::create_directories(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    if (getpid() != made_by_ || !testing::UnitTest::GetInstance()->Passed()) return;
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("canhil-{}", getpid());

 private:
  const pid_t made_by_ = getpid();  // not a child of it
};

}  // namespace

std::string scratch(const std::string& name) {
  static const Folder folder;
  return folder.path / name;
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
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

std::string bus() {
  const char* chosen = std::getenv("CANHIL_TEST_BUS");
  return chosen == nullptr ? "local:" : chosen;
}

std::string scenario(const std::string& name) {
  return fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name);
}

std::vector<Frame> target_frames(const std::string& log_path) {
  auto reader = LogReader::open(log_path);
  if (!reader) throw std::runtime_error(reader.error().message);
  std::vector<Frame> frames;
  bool synchronised = false;
  for (;;) {
    const auto next = reader->next();
    if (!next) throw std::runtime_error(next.error().message);
    if (!*next) return frames;
    const Frame& frame = (*next)->frame;
    synchronised = synchronised || frame.id == messages::Sync::info.id;
    const MessageInfo* info = messages::find_message(frame.id);
    if (!synchronised || info == nullptr || info->sender != messages::TargetHeartbeat::info.sender) continue;
    if (frame.id == messages::TargetTiming::info.id || frame.id == messages::StepDone::info.id) continue;
    frames.push_back(frame);
  }
}

void expect_one_line(const Ended& ended, const std::string& what) {
  EXPECT_EQ(ended.code, 2) << ended.out << ended.err;
  EXPECT_THAT(ended.err, testing::HasSubstr(what));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(ended.out, "");
}

void expect_outputs_passed(const Ended& ended, const nlohmann::json& report) {
  EXPECT_TRUE(report["ending"]["completed"]) << report["ending"];
  int outputs = 0;
  for (const auto& check : report["checks"]) {
    const auto kind = check["kind"].get<std::string>();
    if (kind == "latency" || kind == "output_period" || kind == "heartbeat") continue;
    EXPECT_EQ(check["outcome"], "pass") << check;
    ++outputs;
  }
  EXPECT_GE(outputs, 5);
  const int expected_code = report["verdict"] == "pass" ? 0 : report["verdict"] == "fail" ? 1 : 3;
  EXPECT_EQ(ended.code, expected_code);
}

}  // namespace canhil::test
