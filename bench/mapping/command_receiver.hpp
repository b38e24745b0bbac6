// Passes what the targets command on to the plant that they steer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "bench/mapping/conversation.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/nodes/node.hpp"
#include "bench/plant/simulation.hpp"

namespace canhil::mapping {

class CommandReceiver final : public nodes::Node {
 public:
  /// All arguments must outlive the receiver.
  CommandReceiver(const Conversation& conversation, const plant::Setup& setup, plant::Simulation& simulation);

  /// It sends nothing.
  [[nodiscard]] std::int64_t due_us() const override { return nodes::never_us; }
  void transmit(nodes::Transmission& /*out*/) override {}
  [[nodiscard]] bool listens() const override { return true; }
  /// A command takes effect after its arrival, so the due times do not change.
  bool hear(const Frame& frame, std::int64_t now_us) override;

 private:
  // A message that carries commands: those of its signals and flags, by index of plant::Setup::commands.
  struct Carrier {
    Receiver receiver;
    std::map<const ReportedSignal*, std::size_t> signals;
    std::map<const ReportedFlag*, std::size_t> flags;

    [[nodiscard]] bool carries(std::size_t command) const {
      const auto is_it = [&](const auto& one) { return one.second == command; };
      return std::ranges::any_of(signals, is_it) || std::ranges::any_of(flags, is_it);
    }
  };

  const Conversation& conversation_;
  plant::Simulation& simulation_;
  Places places_;
  std::map<std::size_t, Carrier> carriers_;  // by index of Mapping::hears
  std::vector<double> values_;               // signal values of one message
};

}  // namespace canhil::mapping
