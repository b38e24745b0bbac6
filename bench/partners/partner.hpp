// A program of the user that takes part in a run as a node of the bus: it hears messages, gets true values,
// sends messages, and may change the run (docs/programs.md). It is asked once in each of its periods.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/nodes/node.hpp"
#include "bench/partners/bus_messages.hpp"
#include "bench/partners/control_socket.hpp"
#include "bench/partners/interventions.hpp"
#include "bench/processes/program_lines.hpp"
#include "bench/processes/program_settings.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::partners {

/// What the partners of a run share. Everything that it refers to must outlive them.
struct Stage {
  const scenario::Scenario& scenario;
  std::uint64_t run_index = 0;
  world::Truths truths;
  std::int64_t end_us = 0;
  /// Time waits for the partner's answer to each step. In real time, a partner that is late misses steps.
  bool virtual_time = false;
  bool fd = false;  ///< the bus carries frames of CAN FD
  Interventions& interventions;
};

class Partner final : public nodes::Node {
 public:
  /// Starts the program of a [[node]]. Error, one phrase with its command: it cannot be started, or does not
  /// declare what the protocol says.
  static Result<std::unique_ptr<Partner>> start(const std::string& name,
                                                const processes::ProgramSettings& program,
                                                const Stage& stage);
  /// The client of a control socket, which may come and go. `awaits`: waits for a client, and for its
  /// declarations. Error: no client came, or it did not declare what the protocol says.
  static Result<std::unique_ptr<Partner>> client(ControlSocket& socket, const Stage& stage, bool awaits);
  ~Partner() override;

  [[nodiscard]] std::int64_t due_us() const override { return queued_.empty() ? due_us_ : now_us_; }
  void transmit(nodes::Transmission& out) override;
  [[nodiscard]] bool listens() const override { return true; }
  [[nodiscard]] bool overhears() const override { return true; }
  bool hear(const Frame& frame, std::int64_t now_us) override;

 private:
  using Lines = processes::ProgramLines;

  Partner(std::string name, const Stage& stage, ControlSocket* socket)
      : name_(std::move(name)), stage_(stage), messages_(*stage.scenario.binding), socket_(socket) {}
  Result<void> open(std::unique_ptr<Lines> lines,
                    std::span<const processes::ProgramSettings::Parameter> parameters,
                    std::chrono::microseconds patience);
  Result<void> declarations(bool waits);
  Result<void> declare(std::string_view line);
  void look_for_client();
  Result<void> ask();
  Result<void> answers(bool waits);
  Result<bool> answer(std::string_view line);
  void over(const std::string& why);

  std::string name_;
  Stage stage_;
  BusMessages messages_;
  ControlSocket* socket_;  // null: the bench started the program
  std::unique_ptr<Lines> lines_{};
  std::chrono::microseconds patience_{};
  std::string command_{};
  bool is_ready_ = false;  // it has declared everything
  bool is_asked_ = false;  // its answer to the last step is not complete
  Lines::Time since_{};    // since when it is to declare, or to answer
  std::int64_t period_us_ = usual_period_us, due_us_ = 0, asked_us_ = 0, now_us_ = 0;
  std::vector<const world::TruthValue*> inputs_{};
  std::vector<const dbc::Message*> hears_{};
  bool hears_all_ = false;
  std::string heard_{};  // lines since the last step
  std::deque<Frame> queued_{};

  static constexpr std::int64_t usual_period_us = 10'000;
};

}  // namespace canhil::partners
