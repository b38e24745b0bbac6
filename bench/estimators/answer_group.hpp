// A group of messages that tells an answer.
#pragma once

#include <array>
#include <type_traits>

#include "bench/checks/reception.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::estimators {

template <class... Messages>
class AnswerGroup {
 public:
  static constexpr std::array<std::size_t, sizeof...(Messages)> messages{message_index<Messages>()...};
  [[nodiscard]] static constexpr bool has(std::size_t message) {
    return ((message_index<Messages>() == message) || ...);
  }

  /// True: the group is whole now.
  bool put(const Frame& frame) {
    bool complete = false;
    const auto try_one = [&]<class Message>(std::type_identity<Message>) {
      if (frame.id == Message::info.id)
        complete = group_.put(from_frame<Message>(frame), e2e::counter(frame.payload())) ==
                   SampleGroup<Messages...>::Outcome::complete;
    };
    (try_one(std::type_identity<Messages>{}), ...);
    return complete;
  }
  template <class Message>
  [[nodiscard]] const Message& get() const {
    return group_.template get<Message>();
  }

 private:
  SampleGroup<Messages...> group_;
};

}  // namespace canhil::estimators
