// Rules about the states of the target and the commands to the target.
#include <fmt/format.h>

#include <algorithm>

#include "bench/conformance/rules.hpp"

namespace canhil::conformance {
namespace {

using namespace messages;

// This rule must be tested first, while no command has been sent to the target yet.
std::string beats(Subject& subject) {
  constexpr std::int64_t period_ns = TargetHeartbeat::info.cycle_time_us * 1000;
  constexpr int attempts = 3;  // a busy host may delay the heartbeat
  std::string wrong;
  for (int i = 0; i < attempts; ++i) {
    const auto beats = subject.talk.hear_all<TargetHeartbeat>(12 * period_ns);
    std::vector<std::int64_t> gaps;
    for (std::size_t k = 1; k < beats.size(); ++k) gaps.push_back(beats[k].first - beats[k - 1].first);
    std::ranges::sort(gaps);
    if (gaps.empty()) {
      wrong = fmt::format("{} heartbeats in {:g} s", beats.size(), 12e-9 * static_cast<double>(period_ns));
      continue;
    }
    const std::int64_t median_ns = gaps[gaps.size() / 2];
    const TargetHeartbeat& last = beats.back().second;
    if (last.state != TargetState::idle || last.dbc_hash != exchange_hash24(name_of(last.estimator)))
      return fmt::format("a heartbeat before the first command says {}, DBC hash {:06x}", described(last),
                         last.dbc_hash);
    if (median_ns >= period_ns / 2 && median_ns <= period_ns * 3 / 2) return "";
    wrong = fmt::format("a heartbeat every {:.0f} ms, expected {:.0f}", 1e-6 * static_cast<double>(median_ns),
                        1e-6 * static_cast<double>(period_ns));
  }
  return wrong;
}

std::string refuses_another_contract(Subject& subject) {
  Talk& talk = subject.talk;
  if (auto wrong = talk.make_ready(); !wrong.empty()) return wrong;
  TargetCommand start = talk.command(Command::start);
  start.dbc_hash ^= 1U;
  talk.send(start);
  const auto beat = talk.hear<TargetHeartbeat>([](const auto& one) { return one.error_dbc_mismatch != 0; });
  if (!beat) return "start with another contract's hash: no heartbeat says dbc_mismatch";
  return beat->state == TargetState::running ? "runs: " + described(beat) : "";
}

std::string refuses_another_estimator(Subject& subject) {
  TargetCommand reset = subject.talk.command(Command::reset);
  reset.estimator = Estimator{0b111};  // the largest value of the signal; no estimator has this number
  reset.dbc_hash = exchange_hash24();
  subject.talk.send(reset);
  const auto beat =
      subject.talk.hear<TargetHeartbeat>([](const auto& one) { return one.error_command != 0; });
  return beat && beat->state == TargetState::idle
             ? ""
             : "a reset with an unknown estimator: " + described(beat) + ", expected idle and error_command";
}

std::string refuses_an_unknown_command(Subject& subject) {
  Talk& talk = subject.talk;
  if (auto wrong = talk.make_ready(); !wrong.empty()) return wrong;
  talk.send(talk.command(Command{0b111}));
  const auto beat = talk.hear<TargetHeartbeat>([](const auto& one) { return one.error_command != 0; });
  return beat && beat->state == TargetState::ready
             ? ""
             : "a command that the DBC does not name: " + described(beat) +
                   ", expected ready and error_command";
}

std::string not_started(Talk& talk, const std::string& when) {
  talk.send(talk.command(Command::start));
  const auto beat = talk.hear<TargetHeartbeat>(
      [](const auto& one) { return one.error_not_initialised != 0 || one.state == TargetState::running; });
  if (beat && beat->state != TargetState::running) return "";
  return when + ": " + described(beat);
}

std::string starts_only_with_a_state(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  return not_started(subject.talk, "start without an initial state");
}

std::string takes_its_state_whole(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  subject.talk.send_state([](const Frame& frame) { return frame.id != TargetInitAttitude::info.id; });
  return not_started(subject.talk, "start after an initial state without its attitude");
}

std::string hears_a_repeated_command(Subject& subject) {
  if (auto wrong = made_to_run(subject); !wrong.empty()) return wrong;
  // A bench that restarts may use the same command counter again.
  subject.talk.repeat(subject.talk.command(Command::stop));
  return subject.talk.waits_for(TargetState::idle)
             ? ""
             : "a stop with the counter of the start before it: ignored";
}

std::string reports_its_state(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  return flies(subject);
}

std::string is_quiet_before_the_start(Subject& subject) {
  if (auto wrong = subject.talk.make_ready(); !wrong.empty()) return wrong;
  const int answers = subject.talk.fly(some_flight_us);
  return answers == 0 ? "" : fmt::format("{} answers before the start", answers);
}

std::string stops(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  subject.talk.send(subject.talk.command(Command::stop));
  if (!subject.talk.waits_for(TargetState::idle)) return "stop: its state does not become idle";
  const int answers = subject.talk.fly(2 * some_flight_us);
  return answers == 0 ? "" : fmt::format("{} answers after the stop", answers);
}

std::string starts_again(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  subject.talk.send(subject.talk.command(Command::stop));
  if (!subject.talk.waits_for(TargetState::idle)) return "stop: its state does not become idle";
  const std::string wrong = flies(subject);
  return wrong.empty() ? "" : "after a stop: " + wrong;
}

std::string takes_no_state_while_it_runs(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  subject.talk.send_state();
  const auto beat = subject.talk.hear_in_flight<TargetHeartbeat>(some_flight_us);
  if (!beat) return "no heartbeat in flight";
  return beat->state == TargetState::running && beat->error_command != 0
             ? ""
             : "an initial state in flight: " + described(beat);
}

// A reset must clear the errors and the counters of the target.
std::string forgets(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  subject.talk.send_damaged(10);
  subject.talk.fly(some_flight_us);
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  const auto counted = subject.talk.hear_in_flight<TargetCounters>(some_flight_us);
  const auto beat = subject.talk.last_received<TargetHeartbeat>();
  if (!counted || !beat) return "no counters or no heartbeat in flight";
  if (counted->bad_crc != 0)
    return fmt::format("after a reset {} frames with a bad CRC are counted", counted->bad_crc);
  return beat->error_input_lost == 0 ? "" : "after a reset: " + described(beat);
}

constexpr Rule all[] = {
    {"P-BEAT", "protocol",
     "While no bench runs, a heartbeat with the state idle and the contract's hash comes every 100 ms.",
     beats},
    {"P-CONTRACT", "protocol",
     "A command with another contract's hash is answered with dbc_mismatch and not obeyed.",
     refuses_another_contract},
    {"P-ESTIMATOR", "protocol",
     "A reset with an estimator that the target does not have is answered with error_command.",
     refuses_another_estimator},
    {"P-COMMAND", "protocol",
     "A command that the DBC does not name changes nothing and is answered with error_command.",
     refuses_an_unknown_command},
    {"P-STATE", "protocol",
     "The target reports idle, ready and running as commanded, and answers from the start on.",
     reports_its_state},
    {"P-NO-STATE", "protocol",
     "An estimator without an initial state does not start, and reports not_initialised.",
     starts_only_with_a_state},
    {"P-WHOLE-STATE", "protocol", "An initial state with a missing message is ignored.",
     takes_its_state_whole},
    {"P-REPEAT", "protocol", "A command is obeyed even if its counter repeats the previous one.",
     hears_a_repeated_command},
    {"P-BEFORE", "protocol", "Before the start no sample is answered.", is_quiet_before_the_start},
    {"P-STOP", "protocol", "After a stop nothing is answered.", stops},
    {"P-AGAIN", "protocol", "After a stop the target can be reset and started again.", starts_again},
    {"P-IN-FLIGHT", "protocol",
     "An initial state that comes in flight changes nothing, and is reported as error_command.",
     takes_no_state_while_it_runs},
    {"P-RESET", "protocol", "A reset clears errors and counts.", forgets},
};

}  // namespace

std::span<const Rule> handshake_rules() { return all; }

}  // namespace canhil::conformance
