// A flight as a list of rounds: the frames that the bench sends, and the target's answers to them, computed
// in advance.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/handshake.hpp"
#include "bench/drive/in_process_port.hpp"

namespace canhil {

/// One exchange between the bench and the target: the frames that the bench sends until the target answers,
/// and the frames of the answer.
struct Round {
  std::vector<Frame> stimulus;
  std::vector<Frame> answers;
};

/// Passes all frames to a device in this process and stores its answers.
class RecordingPort final : public Port {
 public:
  SendOutcome send(const Frame& frame) override {
    const SendOutcome outcome = device_.send(frame);
    rounds.back().stimulus.push_back(frame);
    while (const auto answer = device_.receive()) {
      heard_.push_back(*answer);
      rounds.back().answers.push_back(answer->frame);
    }
    if (!rounds.back().answers.empty()) rounds.emplace_back();
    return outcome;
  }
  std::optional<Received> receive() override {
    if (auto first = device_.receive()) return first;  // the heartbeat of a new device comes first
    if (next_ == heard_.size()) return std::nullopt;
    return heard_[next_++];
  }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return device_.name(); }

  std::vector<Round> rounds{1};  // the last round is incomplete: it has no answer yet

 private:
  drive::InProcessPort device_{Rounding::as_on_the_bus};
  std::vector<Received> heard_;
  std::size_t next_ = 0;
};

/// Flies run `run_index` of a scenario with the algorithm `algorithm` instead of the scenario's algorithm.
/// Returns the rounds of the run, which begin with the reset of the target, or one error line.
inline Result<std::vector<Round>> record_flight(const std::string& file, const std::string& algorithm,
                                                std::uint64_t run_index) {
  auto scenario = scenario::read_file(file, drive::contract());
  if (!scenario) return tl::unexpected(scenario.error());
  scenario->targets.front().algorithm = algorithm;
  const auto truth = drive::make_truth(*scenario);
  if (!truth) return tl::unexpected(truth.error());
  auto flight = drive::make_flight(*scenario, *truth, run_index);
  if (!flight) return tl::unexpected(flight.error());

  RecordingPort port;
  drive::Link link(port);
  drive::Schedule schedule = drive::make_schedule(*scenario, *truth, flight->per_run_truth, run_index, false);
  const auto gone = []() -> std::optional<std::string> { return std::nullopt; };
  auto ready = drive::configure(link, schedule.outbox(), scenario->targets, flight->initial, gone);
  if (!ready) return tl::unexpected(ready.error());
  while (schedule.due_us() != nodes::never_us) {
    for (const Frame& frame : schedule.take()) port.send(frame);
  }
  port.rounds.pop_back();
  return std::move(port.rounds);
}

}  // namespace canhil
