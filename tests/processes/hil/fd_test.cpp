// Tests runs on CAN FD: the target must send the same messages as on classic CAN.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <numeric>
#include <optional>
#include <thread>

#include "dbc/logs/log.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/bit_length.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "tests/log_writer.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

const std::string quick = "transfer_alignment_quick";
const std::string fd_file = SOURCE_DIR "/dbc/canhil-fd.dbc";

struct Recorded {
  std::vector<Frame> target;
  nlohmann::json report;
};

Recorded record(const std::string& name, const std::string& options, const std::string& file = "fd") {
  const std::string log = scratch(file + ".log"), json = scratch(file + ".json");
  const Ended ended =
      hil_bench(fmt::format("run {} {} --log {} --json {}", scenario(name), options, log, json));
  EXPECT_NE(ended.code, 2) << ended.err;
  return {.target = target_frames(log), .report = read_json(json)};
}

class FdBitsOfScenario : public testing::TestWithParam<const char*> {};

TEST_P(FdBitsOfScenario, ClassicAndFdAgree) {
  const Recorded classic = record(GetParam(), "--bus in-process", "classic");
  const Recorded fd = record(GetParam(), fmt::format("--bus {} --lockstep --dbc canhil-fd", bus()));
  EXPECT_GT(classic.target.size(), 500U);
  EXPECT_TRUE(classic.target == fd.target)
      << hil_bench(fmt::format("diverge {} {}", scratch("classic.log"), scratch("fd.log"))).out;
  EXPECT_EQ(classic.report["provenance"]["contract"], "canhil");
  EXPECT_EQ(fd.report["provenance"]["contract"], "canhil-fd");
  for (const auto& check : fd.report["checks"]) {
    const auto kind = check["kind"].get<std::string>();
    if (kind == "latency" || kind == "output_period" || kind == "heartbeat") continue;
    EXPECT_EQ(check["outcome"], "pass") << check;
  }
  // Compares the bus load on CAN FD (500 kbit/s nominal, 2 Mbit/s data) with that on classic CAN (500
  // kbit/s). Both runs are in process, so they do not have the frames that lockstep adds.
  const Recorded fd_in_process = record(GetParam(), "--bus in-process --dbc canhil-fd", "fd_in_process");
  const auto load = [](const Recorded& run) { return run.report["bus_load"][0]["mean"].get<double>(); };
  EXPECT_LT(load(fd_in_process), 0.4 * load(classic));
}

INSTANTIATE_TEST_SUITE_P(Fd, FdBitsOfScenario,
                         testing::Values("transfer_alignment_quick", "inflight_quick", "los_quick",
                                         "wind_quick", "all_four"));

TEST(Fd, RealTimeGivesTheSameFrames) {
  const auto in_process = record(quick, "--bus in-process").target;
  std::optional<Recorded> fd;
  ASSERT_EQ(fly_undisturbed([&] {
              fd.emplace(record(quick, fmt::format("--bus {} --dbc {}", bus(), fd_file)));
              return RealTimeRun{.report = fd->report, .log = scratch("fd.log")};
            }),
            "");
  EXPECT_TRUE(in_process == fd->target);
  EXPECT_EQ(fd->report["bus"]["foreign_frames"], 0);
}

/// Records the frames on an FD bus during the lifetime of the object; hosts the bus if it is local.
class Wiretap {
 public:
  explicit Wiretap(const std::string& bus) {
    const PortOptions fd{.fd = true};
    if (bus.starts_with("local:")) {
      port_ = host_local_bus(bus, fd).value();
    } else {
      port_ = open_port(bus, fd).value();
    }
    thread_ = std::thread([this] {
      while (!stop_) {
        wait(*port_, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 10'000'000);
        while (const auto received = port_->receive()) frames_.push_back(received->frame);
      }
    });
  }
  Wiretap(const Wiretap&) = delete;
  Wiretap& operator=(const Wiretap&) = delete;
  ~Wiretap() {
    if (thread_.joinable()) thread_.join();
  }
  const std::vector<Frame>& end() {
    stop_ = true;
    thread_.join();
    return frames_;
  }

 private:
  std::unique_ptr<Port> port_;
  std::atomic<bool> stop_ = false;
  std::vector<Frame> frames_;
  std::thread thread_;
};

// The mean bus load over all complete seconds of the time base except the last one, computed as in the
// report.
double mean_load(const std::vector<Frame>& frames, const wire::BitRates& rates) {
  std::vector<double> seconds;
  for (const Frame& frame : frames) {
    if (frame.id == messages::Sync::info.id)
      seconds.resize(1 + from_frame<messages::Sync>(frame).time_us / 1'000'000);
    if (!seconds.empty()) seconds.back() += wire::duration_s(wire::bit_length(frame), rates);
  }
  seconds.pop_back();
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

TEST(Fd, TheWireCarriesWhatTheLogAndTheReportSay) {
  const std::string name = bus() == "local:" ? fmt::format("local:wiretap-{}", getpid()) : bus();
  const std::string log = scratch("classic.log"), raw = scratch("wire.log"), json = scratch("load.json");
  Wiretap wiretap(name);
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --lockstep --dbc {} --log {} --json {}",
                                            scenario(quick), name, fd_file, log, json));
  ASSERT_NE(ended.code, 2) << ended.err;
  const std::vector<Frame>& frames = wiretap.end();

  auto writer = test::log_writer(raw);
  for (const Frame& frame : frames) writer.write({.interface = "fd0", .frame = frame});
  ASSERT_TRUE(writer.close());
  const Ended compared =
      shell(fmt::format("/usr/bin/python3 {}/fd_frames.py {} {} {} {}/dbc/canhil.dbc {}",
                        SOURCE_DIR "/tests/processes/hil", raw, log, fd_file, SOURCE_DIR, DECODE_FRAMES));
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
  EXPECT_GT(std::atoi(compared.out.c_str()), 10'000);

  // The recording of the FD bus must be usable like the log of the bench: for a replay and for a comparison.
  const std::string replayed = scratch("replayed.log");
  EXPECT_EQ(shell(fmt::format("{} --replay {} > {}", HIL_TARGET, raw, replayed)).code, 0);
  for (const std::string& other : {raw, replayed}) {
    const Ended same = hil_bench(fmt::format("diverge {} {}", log, other));
    EXPECT_EQ(same.code, 0) << same.out << same.err;
  }

  const auto load = read_json(json)["bus_load"][0];
  const wire::BitRates rates{.nominal = load["bitrate_bitps"], .data = load["data_bitrate_bitps"]};
  EXPECT_EQ(rates.data, 2'000'000);
  // A second has 100 steps. In lockstep, the bench may read the answers of the last step after it has begun
  // the next second; therefore the loads may differ by 1 %.
  EXPECT_NEAR(load["mean"].get<double>(), mean_load(frames, rates), 0.01 * mean_load(frames, rates));
}

std::string scenario_with(const std::string& line) {
  std::ofstream(scratch("with.toml")) << line << '\n' << read(scenario(quick));
  return scratch("with.toml");
}

TEST(Fd, AScenarioMayChoose) {
  const std::string json = scratch("chosen.json");
  const std::string file = scenario_with("dbc = \"canhil-fd\"");
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --lockstep --json {}", file, bus(), json));
  ASSERT_NE(ended.code, 2) << ended.err;
  EXPECT_EQ(read_json(json)["provenance"]["contract"], "canhil-fd");
  EXPECT_THAT(ended.out, HasSubstr("CAN FD (canhil-fd)"));
  expect_one_line(hil_bench(fmt::format("run {} --dbc canhil", file)),
                  file + " has dbc = \"canhil-fd\", expected one of the two or both alike");
  EXPECT_NE(hil_bench(fmt::format("run {} --bus in-process --dbc {}", file, fd_file)).code, 2);
  expect_one_line(hil_bench("run " + scenario_with("dbc = \"canhil-df\"")), "'dbc'");
}

TEST(Fd, AContractThatTheProgramsWereNotBuiltWithIsRefused) {
  const std::string other = SOURCE_DIR "/tests/data/dbc/fd.dbc";
  expect_one_line(hil_bench(fmt::format("run {} --dbc {}", scenario(quick), other)),
                  "--dbc: " + other + ": hash ");
  expect_one_line(hil_target("--bus local:nobody --dbc " + other), "expected that of canhil.dbc (");
  expect_one_line(hil_target("--bus local:nobody --dbc nothing.dbc"), "nothing.dbc: cannot be read");
}

TEST(Fd, ALocalBusOfTheOtherFormatIsNamed) {
  const std::string name = fmt::format("local:format-{}", getpid());
  {
    const auto classic = host_local_bus(name, {}).value();
    expect_one_line(hil_target(fmt::format("--bus {} --dbc canhil-fd", name)), "is classic CAN");
    expect_one_line(
        hil_bench(fmt::format("run {} --bus {} --dbc canhil-fd --target none", scenario(quick), name)),
        "is classic CAN");
  }
  const auto fd = host_local_bus(name, {.fd = true}).value();
  expect_one_line(hil_target("--bus " + name), "carries CAN FD");
  expect_one_line(hil_bench(fmt::format("run {} --bus {} --target none", scenario(quick), name)),
                  "carries CAN FD");
}

}  // namespace
}  // namespace canhil::test
