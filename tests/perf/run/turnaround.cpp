// What the target adds to a bus: from the last frame of a Seeker group to the last frame of its answer, over
// the embedded bus, beside a process that only echoes (three frames for the fourth of each group), in one
// run.
//   turnaround [GROUPS]; prints p50, p99 and maximum of both, their ratio, and the answers that did not come.
//
// Groups of the one and the other alternate in blocks, so that whatever else the machine does meets both.
// Time is not awaited: the device's only time is that of the frames.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <vector>

#include "bench/run/contract.hpp"
#include "bench/run/flight.hpp"
#include "bench/run/handshake.hpp"
#include "bench/run/target_process.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil {
namespace {

using namespace messages;

constexpr int block = 500;
constexpr std::int64_t period_us = 5000;
constexpr std::int64_t patience_ns = 1'000'000'000;

// A seeker that looks at a target far away, closing slowly: a flight long enough for every sample.
void put_group(nodes::Transmission& out, std::int64_t k) {
  constexpr double closing_mps = 20;
  const double t_s = 1e-6 * static_cast<double>(k * period_us);
  out.send(SeekerAntenna{.antenna_increment_pitch_rad = 1e-5, .antenna_validity = Validity::valid});
  out.send(SeekerAngles{.error_pitch_rad = 1e-3,
                        .error_yaw_rad = k % 2 == 0 ? 1e-3 : 0.9e-3,
                        .interval_us = period_us,
                        .error_validity = Validity::valid});
  out.send(SeekerMotion{.closing_speed_mps = closing_mps,
                        .acceleration_validity = Validity::valid,
                        .closing_speed_validity = Validity::valid});
  out.send(SeekerRange{.range_m = 9500 - closing_mps * t_s,
                       .time_of_validity_us = wrap_us(k * period_us),
                       .range_validity = Validity::valid});
}

// One side of the comparison: a bus, and who answers on it.
class Side {
 public:
  explicit Side(LocalHub& hub) : hub_(hub) {}

  // Sends a group and waits for the last frame of its answer; counts it as missing after a second.
  void round(bool count) {
    ++k_;
    out_.clear();
    if (k_ % 2 == 1) out_.send(Sync{.time_us = static_cast<std::uint64_t>((k_ + 1) * period_us)});
    put_group(out_, k_);
    std::int64_t sent_ns = 0;
    for (const Frame& frame : out_.frames()) {
      sent_ns = clock_ns(CLOCK_MONOTONIC);
      while (hub_.send(frame) == SendOutcome::queue_full) wait(hub_, WaitFor::room, no_deadline);
    }
    if (!answered(sent_ns + patience_ns)) {
      ++missing;
    } else if (count) {
      ns.push_back(clock_ns(CLOCK_MONOTONIC) - sent_ns);
    }
  }
  nodes::Transmission& out() { return out_; }

  std::vector<std::int64_t> ns;
  int missing = 0;

 private:
  bool answered(std::int64_t deadline_ns) {
    while (!hub_.closed() && clock_ns(CLOCK_MONOTONIC) < deadline_ns) {
      while (const auto received = hub_.receive()) {
        if (received->frame.id == LosRateTarget::info.id) return true;
      }
      wait(hub_, WaitFor::frame, deadline_ns);
    }
    return false;
  }

  LocalHub& hub_;
  nodes::Transmission out_;
  std::int64_t k_ = 0;
};

// Answers the last frame of each group with three frames; the last has the id that ends an answer.
[[noreturn]] void echo(const std::string& bus) {
  auto node = join_local_bus(bus, {});
  if (!node) ::_exit(1);
  while (!(*node)->closed()) {
    while (const auto received = (*node)->receive()) {
      if (received->frame.id != SeekerRange::info.id) continue;
      Frame answer = received->frame;
      for (const std::uint32_t id :
           {LosRateEstimate::info.id, LosRateSigma::info.id, LosRateTarget::info.id}) {
        answer.id = id;
        static_cast<void>((*node)->send(answer));
      }
    }
    wait(**node, WaitFor::frame, no_deadline);
  }
  ::_exit(0);
}

double us(const std::vector<std::int64_t>& sorted, double quantile) {
  return 1e-3 * static_cast<double>(
                    sorted[static_cast<std::size_t>(quantile * static_cast<double>(sorted.size() - 1))]);
}

int complain(const std::string& what) {
  fmt::print(stderr, "turnaround: {}\n", what);
  return 2;
}

int compare(int groups) {
  const auto scenario = scenario::read_file(SOURCE_DIR "/bench/scenarios/los_quick.toml", run::contract());
  if (!scenario) return complain(scenario.error().message);
  const auto truth = run::make_truth(*scenario);
  if (!truth) return complain(truth.error().message);
  const auto own_truth = run::make_own_truth(*scenario, 0);
  if (!own_truth) return complain(own_truth.error().message);
  const auto initial = run::make_initial_states(*scenario, *truth, *own_truth, 0);
  if (!initial) return complain(initial.error().message);

  const std::string bus = fmt::format("local:turnaround-{}", ::getpid()), echo_bus = bus + "-echo";
  auto hub = host_local_bus(bus, {}), echo_hub = host_local_bus(echo_bus, {});
  if (!hub || !echo_hub) return complain("cannot host an embedded bus");
  const pid_t child = ::fork();
  if (child == 0) echo(echo_bus);
  auto target = run::TargetProcess::start(HIL_TARGET, bus);
  if (!target) return complain(target.error().message);

  Side device(**hub), bare(**echo_hub);
  run::Link link(**hub);
  const auto configured =
      run::configure(link, device.out(), scenario->targets, *initial, [&] { return target->ended(); });
  if (!configured) return complain(configured.error().message);
  while ((*echo_hub)->nodes().empty()) {  // until the echo has joined
    static_cast<void>((*echo_hub)->receive());
    ::usleep(1000);
  }
  for (int n = 0; n < groups + block; n += block) {  // the first block warms up
    for (int i = 0; i < block; ++i) bare.round(n > 0);
    for (int i = 0; i < block; ++i) device.round(n > 0);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  if (bare.ns.empty() || device.ns.empty()) return complain("no answers");
  std::ranges::sort(bare.ns);
  std::ranges::sort(device.ns);
  fmt::print("{} groups each           p50      p99       max   unanswered\n", groups);
  for (const auto& [name, side] :
       {std::pair("echo process", &bare), std::pair("hil-target, LOS rate", &device)})
    fmt::print("{:<22}{:>9.2f}{:>9.2f}{:>10.2f}  us{:>9}\n", name, us(side->ns, 0.5), us(side->ns, 0.99),
               us(side->ns, 1), side->missing);
  fmt::print("ratio of p50 {:.3f}, of p99 {:.3f}\n", us(device.ns, 0.5) / us(bare.ns, 0.5),
             us(device.ns, 0.99) / us(bare.ns, 0.99));
  return 0;
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) { return canhil::compare(argc > 1 ? std::atoi(argv[1]) : 20'000); }
