#include "bench/mapping/command_receiver.hpp"

#include <cmath>

#include "bench/mapping/reading.hpp"

namespace canhil::mapping {

CommandReceiver::CommandReceiver(const Conversation& conversation, const plant::Setup& setup,
                                 plant::Simulation& simulation)
    : conversation_(conversation), simulation_(simulation), places_(conversation.mapping) {
  const auto& hears = conversation.mapping.hears;
  for (std::size_t command = 0; command < setup.commands.size(); ++command) {
    const std::string& from = setup.commands[command].from;
    for (std::size_t i = 0; i < hears.size(); ++i) {
      for (const ReportedSignal& one : hears[i].reported_signals) {
        if (one.what == ReportedSignal::What::value && one.quantity->quantity->name == from)
          carriers_[i].signals[&one] = command;
      }
      for (const ReportedFlag& one : hears[i].flags) {
        if (one.name == from) carriers_[i].flags[&one] = command;
      }
      const auto own = carriers_.find(i);
      if (own != carriers_.end() && own->second.carries(command) && !hears[i].is_owed())
        simulation.note_unawaited(command, hears[i].of.message->name);
    }
  }
}

bool CommandReceiver::hear(const Frame& frame, std::int64_t now_us) {
  for (const std::size_t index : places_.hears(frame)) {
    const auto carrier = carriers_.find(index);
    if (carrier == carriers_.end()) continue;
    const Hear& hear = conversation_.mapping.hears[index];
    Carrier& of = carrier->second;
    const Receiver::Taken taken = of.receiver.take(hear.of, frame);
    if (taken.outcome != Receiver::Outcome::whole) continue;
    const Sent* cause = hear.answers ? cause_of(conversation_, hear, taken.bytes) : nullptr;
    const std::int64_t cause_us = cause == nullptr ? -1 : cause->valid_us;
    const auto give = [&](std::size_t command, double value) {
      simulation_.give(command, {.t_us = now_us, .value = value, .cause_us = cause_us});
    };
    read(hear, taken.bytes, values_, [&](const ReportedSignal& signal, double value, bool /*invalid*/) {
      const auto found = of.signals.find(&signal);
      if (found != of.signals.end()) give(found->second, value);
    });
    for (const auto& [flag, command] : of.flags) {
      if (const auto state = state_of(hear, *flag, taken.bytes)) give(command, *state ? 1 : 0);
    }
  }
  return false;
}

}  // namespace canhil::mapping
