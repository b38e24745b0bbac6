// Iterates over the messages and signals of a sample group that is known only at run time.
#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "bench/scenario/node.hpp"
#include "dbc/wire/message_info.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {

/// Calls visit.operator()<Message>() for each message of the sample group that ends with `closes`, in the
/// order of ids.
template <class Visit>
void each_message(const MessageInfo& closes, Visit visit) {
  const auto one = [&]<class Message>(std::type_identity<Message>) {
    const bool same_group = !closes.sample_group.empty() && Message::info.sample_group == closes.sample_group;
    if (same_group || Message::info.id == closes.id) visit.template operator()<Message>();
  };
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (one(std::type_identity<Messages>{}), ...);
  }(std::type_identity<messages::AllMessages>{});
}

/// The meaning of a signal in its group.
enum class Role : std::uint8_t { time_of_validity, interval, validity, value };

struct GroupSignal {
  SignalInfo info;
  Role role = Role::value;
};

inline Role role_of(const SignalInfo& signal) {
  if (signal.name == "time_of_validity_us") return Role::time_of_validity;
  if (signal.name == "interval_us") return Role::interval;
  return signal.name.ends_with("_validity") ? Role::validity : Role::value;
}

/// All signals of the group, message by message.
inline std::vector<GroupSignal> signals_of(const MessageInfo& closes) {
  std::vector<GroupSignal> all;
  each_message(closes, [&]<class Message>() {
    const Message message{};
    Message::visit(message, [&](const SignalInfo& signal, const auto& /*member*/) {
      all.push_back({.info = signal, .role = role_of(signal)});
    });
  });
  return all;
}

}  // namespace canhil::nodes
