#include "bench/mapping/stimuli.hpp"

#include <algorithm>
#include <vector>

#include "bench/nodes/recorded_group.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/observe/values.hpp"
#include "bench/quantities/wire_unit.hpp"
#include "dbc/wire/turns.hpp"
#include "messages/canhil.hpp"

namespace canhil::mapping {
namespace {

using nodes::Role;
using nodes::role_of;

// "latitude_deg" -> "latitude": signal names in canhil's DBC end in their units.
std::string_view without_unit(std::string_view signal) { return signal.substr(0, signal.rfind('_')); }

std::vector<Stimulus> all_stimuli() {
  std::vector<Stimulus> all;
  for (const nodes::Kind* kind : nodes::all()) {
    const scenario::NodeTable& table = kind->table;
    for (const MessageInfo& message : messages::all_messages) {
      if (message.sample_group != table.closes.sample_group || message.sender != table.closes.sender)
        continue;
      const std::vector<const SignalInfo*> signals = observe::signals_of(message);
      const bool flagged =
          std::ranges::any_of(signals, [](const auto* one) { return role_of(*one) == Role::validity; });
      for (const SignalInfo* signal : signals) {
        const auto unit = signal->unit.empty() ? std::nullopt : quantities::wire_unit(signal->unit);
        // The time and the interval of a sample are not measurements, and a mapping defines its own time
        // signals.
        if (!unit || role_of(*signal) != Role::value) continue;
        Stimulus stimulus{.name = std::string(table.key) + "." + std::string(without_unit(signal->name)),
                          .si = unit->si,
                          .node = table.key,
                          .message = &message,
                          .signal = signal->name,
                          .column = signal->name,
                          .factor = unit->factor,
                          .turns = wire::turns(*signal),
                          .flagged = flagged};
        const auto increment =
            std::ranges::find(table.increments, signal->name, &scenario::Increment::signal);
        if (increment != table.increments.end()) {
          stimulus.over = Over::sum;
          all.push_back(stimulus);
          stimulus.name = increment->quantity;
          stimulus.column = increment->rate;
          stimulus.si = stimulus.si == "rad" ? "rad/s" : "m/s^2";
          stimulus.over = Over::rate;
        }
        all.push_back(stimulus);
      }
    }
  }
  return all;
}

}  // namespace

std::span<const Stimulus> stimuli() {
  static const std::vector<Stimulus> all = all_stimuli();
  return all;
}

const Stimulus* find_stimulus(std::string_view name) {
  const auto found = std::ranges::find(stimuli(), name, &Stimulus::name);
  return found == stimuli().end() ? nullptr : &*found;
}

}  // namespace canhil::mapping
