// A quick flight with faults, without a target: the test examines the frames that the bench sends.
#pragma once

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/faults/in_run.hpp"
#include "bench/nodes/registry.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {

inline Result<scenario::Scenario> parsed(const std::string& faults,
                                         const std::string& flight = "transfer_alignment_quick") {
  std::stringstream text;
  text << std::ifstream(SOURCE_DIR "/bench/flights/" + flight + ".toml").rdbuf() << "\n" << faults;
  return drive::parse_scenario(text.str(), "test.toml");
}

/// The text of one fault of this kind; only further tables may follow this text.
inline std::string fault(const std::string& kind, const std::string& more) {
  return "[[fault]]\nkind = \"" + kind + "\"\n" + more;
}

/// The error message when these faults are read; "nothing" if they are accepted.
inline std::string refusal(const std::string& faults) {
  const auto scenario = parsed(faults);
  return scenario ? "nothing" : scenario.error().message;
}

/// Records the calls.
class Noted final : public RigControl {
 public:
  void pause_target() override { done.emplace_back("pause"); }
  void resume_target() override { done.emplace_back("resume"); }
  void restart_target(std::int64_t t_us) override { done.push_back("restart at " + std::to_string(t_us)); }
  void report_error(const Frame& error) override { errors.push_back(error); }
  void interface_down(std::int64_t for_us) override { done.push_back("down for " + std::to_string(for_us)); }
  void interface_up() override { done.emplace_back("up"); }
  std::vector<std::string> done;
  std::vector<Frame> errors;
};

inline const Place everything{.bus = "vcan0",
                              .interface = Place::Interface::virtual_can,
                              .may_set_interface = true,
                              .starts_target = true,
                              .wire = {.rates = {.nominal = 500'000}}};

/// Frames, each with the time at which it is sent.
using Timed = std::vector<std::pair<std::int64_t, Frame>>;

/// A run of a flight with these faults, without a target.
struct Flight {
  explicit Flight(const std::string& faults, std::uint64_t run = 0,
                  Rounding rounding = Rounding::as_on_the_bus,
                  const std::string& flight = "transfer_alignment_quick")
      : scenario(parsed(faults, flight).value()),
        truth(drive::make_truth(scenario).value()),
        own(drive::make_flight(scenario, truth, run).value()),
        schedule(drive::make_schedule(
            scenario, truth, own.per_run_truth, run, true, rounding,
            std::make_unique<Faults>(scenario, run, messages::all_messages, everything, &hands))) {
    while (schedule.due_us() != nodes::never_us) {
      const std::int64_t t_us = schedule.due_us();
      for (const Frame& frame : schedule.take()) frames.emplace_back(t_us, frame);
    }
  }
  Flight(const Flight&) = delete;

  /// The frames of one message.
  [[nodiscard]] Timed of(std::uint32_t id) const {
    Timed some;
    for (const auto& one : frames) {
      if (one.second.id == id) some.push_back(one);
    }
    return some;
  }
  [[nodiscard]] std::uint64_t count() const { return schedule.faults()->reports().front().count; }

  Noted hands;
  scenario::Scenario scenario;
  world::FlightRecord truth;
  drive::Flight own;
  drive::Schedule schedule;
  Timed frames;
};

/// All messages of one kind in a flight, each with the time at which it is sent. Their CRCs must be right.
template <class Message>
std::vector<std::pair<std::int64_t, Message>> said(const Flight& flight) {
  std::vector<std::pair<std::int64_t, Message>> all;
  for (const auto& [t_us, frame] : flight.of(Message::info.id)) {
    EXPECT_EQ(frame.data[0], e2e::crc(frame.payload(), Message::info.e2e_data_id)) << t_us;
    all.emplace_back(t_us, from_frame<Message>(frame));
  }
  return all;
}

}  // namespace canhil::faults
