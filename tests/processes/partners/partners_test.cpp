// Programs of the user that take part in a run: a sensor, nodes of the bus, a client of the control socket.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string examples = SOURCE_DIR "/docs/examples/";
const std::string uav = " --lockstep --target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/uav/uav.py'";

// The frames of a log without its stamps and the name of the bus.
std::vector<std::string> frames_of(const std::string& log) {
  std::vector<std::string> frames;
  std::ifstream file(log);
  for (std::string stamp, bus, frame, side; file >> stamp >> bus >> frame >> side;)
    frames.push_back(frame + " " + side);
  return frames;
}

TEST(Partners, TheExampleHasTheSameBitsInEachRun) {
  std::vector<std::vector<std::string>> runs;
  for (const std::string log : {"first.log", "second.log"}) {
    const Ended ended =
        hil_bench(fmt::format("run {}partners/uav.toml{} --log {}", examples, uav, scratch(log)));
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("'disturber' began the fault 'gyro of IMU A off'"));
    runs.push_back(frames_of(scratch(log)));
  }
  EXPECT_EQ(runs[0], runs[1]);
  const auto of = [&](const std::string& id) {
    return std::ranges::count_if(runs[0], [&](const std::string& frame) { return frame.starts_with(id); });
  };
  EXPECT_EQ(of("5A0#"), 40) << "the gateway's, each 0.5 s from the second step on";
  EXPECT_GT(of("001#"), 20) << "the disturber's";
}

TEST(Partners, AMagnetometerWithHardIronFails) {
  const Ended ended = hil_bench(
      fmt::format("run {}partners/uav.toml{} --set magnetometer.parameters.hard_iron_ut=15", examples, uav));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("FAIL          error attitude.heading"));
}

// A quick flight against the device in the bench's process. `sensor` is put into [seeker] in place of its
// keys, if it is not empty; `further` at the end.
std::string quick(const std::string& name, const std::string& sensor, const std::string& further) {
  std::string text = read(SOURCE_DIR "/bench/flights/los_quick.toml");
  if (!sensor.empty()) {
    const std::size_t from = text.find("[seeker]\n") + 9, to = text.find("\n[", from);
    text.replace(from, to - from, sensor);
  }
  std::ofstream(scratch(name + ".toml")) << text << further;
  return scratch(name + ".toml");
}

std::string python(const std::string& name, const std::string& code) {
  std::ofstream(scratch(name + ".py"))
      << "import sys\nsys.path.append('" SOURCE_DIR "/python/canhil')\nimport partner\n"
      << code;
  return fmt::format("/usr/bin/python3 {}", scratch(name + ".py"));
}

struct Wrong {
  std::string name, code;
  int exit_code = 0;
  std::string says;
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }
std::string name_of(const testing::TestParamInfo<Wrong>& one) { return one.param.name; }

// The program prints what it declares, then what it answers to each step.
std::string answers(const std::string& declared, const std::string& each) {
  return fmt::format(
      "for line in sys.stdin:\n  if line == 'start\\n': break\n"
      "print({}, flush=True)\n"
      "for line in sys.stdin:\n  if line.startswith('step'):\n    {}\n",
      declared, each);
}

class WrongNode : public testing::TestWithParam<Wrong> {};

TEST_P(WrongNode, EndsTheRunWithOneLine) {
  const auto& [name, code, exit_code, says] = GetParam();
  const std::string file = quick(name, "",
                                 fmt::format("\n[[node]]\nname = \"mine\"\ncommand = \"{}\"\n"
                                             "answers_within_s = 0.5\nstarts_within_s = 3\n",
                                             python(name, code)));
  const Ended ended = hil_bench(fmt::format("run {} --bus in-process", file));
  EXPECT_EQ(ended.code, exit_code) << ended.out << ended.err;
  EXPECT_THAT(ended.out + ended.err, HasSubstr(says));
}

INSTANTIATE_TEST_SUITE_P(
    , WrongNode,
    testing::Values(
        Wrong{"unknown_message", answers("'hear NoSuchMessage\\nready'", "pass"), 2,
              "a message of the DBC, or *"},
        Wrong{"unknown_truth", answers("'input plant.nothing\\nready'", "pass"), 2,
              "no truth of plant.nothing"},
        Wrong{"period_of_zero", answers("'period 0\\nready'", "pass"), 2, "a period of 0.0001 to 3600 s"},
        Wrong{"not_a_declaration", answers("'hello'", "pass"), 2, "wrote 'hello'"},
        Wrong{"exits_at_once", "sys.exit(3)\n", 2, "exited with 3"},
        Wrong{"hangs_at_the_start", "import time\ntime.sleep(60)\n", 2, "did not answer within 3 s"},
        Wrong{"exits", answers("'ready'", "sys.exit(4)"), 3, "exited with 4"},
        Wrong{"hangs", answers("'ready'", "import time; time.sleep(60)"), 3, "did not answer within 0.5 s"},
        Wrong{"sends_what_is_unknown", answers("'ready'", "print('send Nothing x=1\\ndone', flush=True)"), 3,
              "message 'Nothing' is unknown"},
        Wrong{"sends_an_unknown_signal",
              answers("'ready'", "print('send SeekerRange x=1\\ndone', flush=True)"), 3, "has no signal 'x'"},
        Wrong{"sends_no_number", answers("'ready'", "print('send SeekerLos x=nan\\ndone', flush=True)"), 3,
              "SIGNAL=NUMBER"},
        Wrong{"sends_no_frame", answers("'ready'", "print('frame 123456\\ndone', flush=True)"), 3,
              "is no frame"},
        Wrong{"begins_no_fault", answers("'ready'", "print('begin bias\\ndone', flush=True)"), 3,
              "there is no fault 'bias'"},
        Wrong{"sets_no_value", answers("'ready'", "print('set seeker.nothing 1\\ndone', flush=True)"), 3,
              "has no value 'nothing'"},
        Wrong{"writes_nonsense", answers("'ready'", "print('x' * 100000, end='', flush=True)"), 3,
              "without a line end"}),
    name_of);

class WrongSensor : public testing::TestWithParam<Wrong> {};

TEST_P(WrongSensor, IsRefusedOrEndsTheRun) {
  const auto& [name, code, exit_code, says] = GetParam();
  const std::string file = quick(
      name,
      fmt::format("command = \"{}\"\nanswers_within_s = 0.5\nstarts_within_s = 3\n", python(name, code)), "");
  const Ended ended = hil_bench(fmt::format("run {} --bus in-process", file));
  EXPECT_EQ(ended.code, exit_code) << ended.out << ended.err;
  EXPECT_THAT(ended.out + ended.err, HasSubstr(says));
}

// Declares all values of a seeker.
std::string seeker(const std::string& each) {
  std::string declared;
  for (const std::string_view one :
       {"antenna_increment_roll rad", "antenna_increment_pitch rad", "antenna_increment_yaw rad",
        "error_pitch rad", "error_yaw rad", "missile_acceleration_y m/s^2", "missile_acceleration_z m/s^2",
        "closing_speed m/s", "range m", "valid.range 1"})
    declared += fmt::format("output {}\\n", one);
  return answers(fmt::format("'{}state 0 0 0 0 0 0 0 0 0 1'", declared), each);
}

INSTANTIATE_TEST_SUITE_P(
    , WrongSensor,
    testing::Values(Wrong{"lacks_a_value", answers("'output error_pitch rad\\nstate 0'", "pass"), 2,
                          "is missing, expected 'output "},
                    Wrong{"has_an_unknown_value", answers("'output size m\\nstate 0'", "pass"), 2,
                          "output 'size' is no value of the sensor"},
                    Wrong{"has_another_unit", answers("'output error_pitch m\\nstate 0'", "pass"), 2,
                          "is declared in 'm', expected 'rad'"},
                    Wrong{"reads_an_unknown_value",
                          answers("'input nothing m\\noutput error_pitch rad\\nstate 0'", "pass"), 2,
                          "input 'nothing' is no true value"},
                    Wrong{"exits_before", "sys.exit(3)\n", 2, "exited with 3"},
                    Wrong{"exits", seeker("sys.exit(4)"), 3, "exited with 4"},
                    Wrong{"hangs", seeker("import time; time.sleep(60)"), 3, "did not answer within 0.5 s"},
                    Wrong{"measures_no_number", seeker("print('state 0 0 0 0 0 0 0 0 nan 1', flush=True)"), 3,
                          "wrote nan for 'range', expected a finite number"},
                    Wrong{"measures_too_little", seeker("print('state 0', flush=True)"), 3,
                          "the number of values is 1, expected 10"}),
    name_of);

TEST(Partners, KeysOfTheModelHaveNoEffectBesideACommand) {
  const std::string file =
      quick("beside",
            fmt::format("command = \"{}\"\nmax_noise_mrad = 1\n",
                        python("beside", answers("'output error_pitch rad\\nstate 0'", "pass"))),
            "");
  const Ended ended = hil_bench(fmt::format("run {} --bus in-process", file));
  EXPECT_EQ(ended.code, 2);
}

// ---- faults that begin in the run

const std::string spike =
    "\n[[fault]]\nname = \"spike\"\nkind = \"bias\"\nquantity = \"seeker.error_pitch\"\nby_mrad = 4\n";

TEST(FaultsInTheRun, BeginWhenAConditionHolds) {
  const std::string report = scratch("condition.json");
  const std::string file = quick("condition", "", spike + "when = \"plant.range < 1000\"\nfor_s = 0.25\n");
  const Ended ended = hil_bench(fmt::format("run {} --bus in-process --json {}", file, report));
  EXPECT_EQ(ended.code, 1) << ended.err;
  const nlohmann::json fault = read_json(report)["faults"][0];
  EXPECT_DOUBLE_EQ(fault["windows"][0]["from_s"], 4.45);
  EXPECT_DOUBLE_EQ(fault["windows"][0]["to_s"], 4.7);
  EXPECT_EQ(fault["count"], 51) << "one for each 5 ms, ends included";
}

TEST(FaultsInTheRun, DoNotStrikeIfTheirConditionNeverHolds) {
  const std::string report = scratch("never.json");
  const std::string file = quick("never", "", spike + "when = \"plant.range < -1\"\n");
  hil_bench(fmt::format("run {} --bus in-process --json {}", file, report));
  const nlohmann::json fault = read_json(report)["faults"][0];
  EXPECT_EQ(fault["count"], 0);
  EXPECT_EQ(fault["windows"].size(), 0U);
}

TEST(FaultsInTheRun, HaveNoTimesInTheScenario) {
  for (const std::string wrong :
       {"when = \"plant.range < 1000\"\nfrom_s = 1\n", "when = \"plant.range <\"\n",
        "when = \"no_such_truth < 1\"\n",
        "when = \"command\"\n[[check]]\nkind = \"recovers_within\"\nfault = \"spike\"\n"
        "within_s = 1\nquantity = \"los.rate.pitch\"\nbelow_degps = 1\n"}) {
    const Ended ended = hil_bench(fmt::format("run {} --bus in-process", quick("times", "", spike + wrong)));
    EXPECT_EQ(ended.code, 2) << wrong << ended.out;
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
  }
}

// ---- the control socket

// A client: connects, and reads and writes lines.
class Client {
 public:
  explicit Client(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    for (int i = 0; i < 2000; ++i) {
      socket_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
      if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
      ::close(socket_);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "cannot connect to " << path;
  }
  ~Client() { ::close(socket_); }
  void write(const std::string& text) const {
    EXPECT_EQ(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  // Reads lines up to one that begins with these words; empty: there is none.
  std::string until(const std::string& words) {
    while (true) {
      const std::size_t end = text_.find('\n');
      if (end != std::string::npos) {
        const std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        if (line.starts_with(words)) return line;
        continue;
      }
      char some[4096];
      const ssize_t got = ::recv(socket_, some, sizeof some, 0);
      if (got <= 0) return {};
      text_.append(some, static_cast<std::size_t>(got));
    }
  }

 private:
  int socket_ = -1;
  std::string text_;
};

TEST(ControlSocket, AClientComesAndGoesAndComesAgain) {
  const std::string socket = scratch("again");
  const std::string file = quick("again", "", spike + "when = \"command\"\n");
  Ended ended;
  std::thread bench([&] {
    ended = hil_bench(fmt::format("run {} --bus in-process --control {} --await-control", file, socket));
  });
  {
    Client first(socket);
    EXPECT_EQ(first.until("canhil-node"), "canhil-node 1");
    first.write("period 0.1\nready\n");
    EXPECT_EQ(first.until("step"), "step 0 0");
    first.write("begin spike\ndone\n");
    EXPECT_EQ(first.until("step"), "step 0 100000");
    first.write("end spike\nset seeker.error_yaw 0.001\ndone\n");
    EXPECT_EQ(first.until("step"), "step 100000 200000");
    first.write("begin nothing\ndone\n");
    EXPECT_THAT(first.until("error"), HasSubstr("there is no fault 'nothing'"));
  }
  bench.join();
  EXPECT_THAT(ended.out, HasSubstr("t=0.000 s: 'control' began the fault 'spike'"));
  EXPECT_THAT(ended.out, HasSubstr("t=0.100 s: 'control' set seeker.error_yaw to 0.001"));
  EXPECT_NE(::access(socket.c_str(), F_OK), 0) << "the socket is removed";
}

TEST(ControlSocket, APathThatExistsIsRefusedAndKept) {
  const std::string path = scratch("occupied");
  std::ofstream(path) << "mine\n";
  const Ended ended = hil_bench(
      fmt::format("run {} --bus in-process --control {}", SOURCE_DIR "/bench/flights/los_quick.toml", path));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("Address already in use"));
  EXPECT_EQ(read(path), "mine\n");
}

TEST(ControlSocket, InRealTimeTheRunDoesNotWait) {
  const std::string socket = scratch("slow");
  const std::string report = scratch("slow.json");
  Ended ended;
  std::thread bench([&] {
    ended = hil_bench(
        fmt::format("run {} --control {} --await-control --json {}", quick("slow", "", ""), socket, report));
  });
  Client client(socket);
  client.write("period 0.01\nhear LosRateEstimate\nready\n");
  EXPECT_EQ(client.until("clock"), "clock real");
  EXPECT_THAT(client.until("step"), HasSubstr("step"));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // without an answer
  client.write("done\n");
  EXPECT_THAT(client.until("heard"), HasSubstr("LosRateEstimate"));
  bench.join();
  EXPECT_THAT(ended.out, HasSubstr("'control' was not ready for"));
  EXPECT_THAT(ended.out, Not(HasSubstr("target silent")));
}

}  // namespace
}  // namespace canhil::test
