// Iterates over the messages and signals of a sample group that is known only at run time.
#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "bench/sensors/sample.hpp"
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

/// A signal of a sample group, and what it carries.
struct SampleSignal {
  const MessageInfo* message = nullptr;
  SignalInfo info;
  sensors::Role role = sensors::Role::value;
  std::size_t index = 0;  ///< of the value or flag in the sample
  double factor = 1;      ///< from the unit of the signal to SI
};

/// All signals of the group, message by message. Each signal carries the value or flag of its name: the name
/// of the signal without its unit ("velocity_north_mps"), or without "_validity".
std::vector<SampleSignal> signals_of(const MessageInfo& closes, const sensors::Outputs& outputs);

/// The columns of a recording of a sensor that canhil.dbc does not carry. Values are in SI, with the unit in
/// the name ("velocity_x_mps"). There is no message.
std::vector<SampleSignal> signals_in_si(const sensors::Outputs& outputs);

}  // namespace canhil::nodes
