#include "bench/nodes/sample_signals.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bench/quantities/wire_unit.hpp"

namespace canhil::nodes {
namespace {

using sensors::Role;

Role role_of(const SignalInfo& signal) {
  if (signal.name == "time_of_validity_us") return Role::time_of_validity;
  if (signal.name == "interval_us") return Role::interval;
  return signal.name.ends_with("_validity") ? Role::validity : Role::value;
}

// The index of the name in `names` that stands before the last underscore of `signal`, or that is `signal`.
template <class Names, class Name>
std::optional<std::size_t> place(const Names& names, std::string_view signal, Name name_of) {
  for (const std::string_view name : {signal.substr(0, signal.rfind('_')), signal}) {
    const auto found = std::ranges::find(names, name, name_of);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

}  // namespace

std::vector<SampleSignal> signals_of(const MessageInfo& closes, const sensors::Outputs& outputs) {
  std::vector<SampleSignal> all;
  each_message(closes, [&]<class Message>() {
    const Message message{};
    Message::visit(message, [&](const SignalInfo& signal, const auto& /*member*/) {
      SampleSignal one{.message = &Message::info, .info = signal, .role = role_of(signal)};
      if (one.role == Role::value)
        one.index = place(outputs.values, signal.name, &sensors::Output::name).value();
      if (one.role == Role::validity) one.index = place(outputs.flags, signal.name, std::identity{}).value();
      if (const auto unit = quantities::wire_unit(signal.unit)) one.factor = unit->factor;
      all.push_back(one);
    });
  });
  return all;
}

std::vector<SampleSignal> signals_in_si(const sensors::Outputs& outputs) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 8> endings{{{"rad/s", "_radps"},
                                                                                         {"rad", "_rad"},
                                                                                         {"m/s^2", "_mps2"},
                                                                                         {"m/s", "_mps"},
                                                                                         {"m", "_m"},
                                                                                         {"Pa", "_pa"},
                                                                                         {"K", "_k"},
                                                                                         {"T", "_t"}}};
  static std::mutex mutex;
  static std::deque<std::string> names;  // SignalInfo keeps no text of its own
  const std::lock_guard lock(mutex);
  std::vector<SampleSignal> all;
  const auto add = [&](std::string name, std::string_view unit, Role role, std::size_t index) {
    constexpr double any = std::numeric_limits<double>::infinity();
    all.push_back({.info = {.name = names.emplace_back(std::move(name)),
                            .unit = unit,
                            .minimum = -any,
                            .maximum = any,
                            .is_float = true},
                   .role = role,
                   .index = index});
  };
  for (std::size_t i = 0; i < outputs.values.size(); ++i) {
    const sensors::Output& output = outputs.values[i];
    const auto ending = std::ranges::find(endings, output.si, [](const auto& one) { return one.first; });
    add(std::string(output.name) + std::string(ending == endings.end() ? "" : ending->second), output.si,
        Role::value, i);
  }
  for (std::size_t i = 0; i < outputs.flags.size(); ++i)
    add(std::string(outputs.flags[i]) + "_validity", "", Role::validity, i);
  return all;
}

}  // namespace canhil::nodes
