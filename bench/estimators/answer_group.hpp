// Assembles groups of messages that carry answers.
#pragma once

#include <array>
#include <tuple>
#include <type_traits>

#include "bench/checks/reception.hpp"
#include "dbc/spool/in_order.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/time_base.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::estimators {

/// A group of answer messages, listed in the order of transmission. The last message carries the time of the
/// cause.
template <class... Messages>
class AnswerGroup {
 public:
  [[nodiscard]] static constexpr bool has(std::size_t message) {
    return ((message_index<Messages>() == message) || ...);
  }

  /// Adds a frame to the group. Returns true if the group is now complete.
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
  /// Describes a complete group and its cause.
  [[nodiscard]] Whole whole(std::int64_t now_us) const {
    using Last = std::tuple_element_t<sizeof...(Messages) - 1, std::tuple<Messages...>>;
    return {.messages = messages,
            .cause_us = unwrap_us(get<Last>().cause_time_us, now_us),
            .cause_group = Last::info.answers.front(),
            .cause_counter = cause_counter()};
  }
  template <class Message>
  [[nodiscard]] const Message& get() const {
    return group_.template get<Message>();
  }

 private:
  // The counter of the cause, if one of the messages carries it.
  [[nodiscard]] std::optional<std::uint8_t> cause_counter() const {
    std::optional<std::uint8_t> counter;
    const auto look_at = [&](const auto& message) {
      if constexpr (requires { message.cause_counter; })
        counter = static_cast<std::uint8_t>(message.cause_counter);
    };
    (look_at(get<Messages>()), ...);
    return counter;
  }

  static constexpr std::array<std::size_t, sizeof...(Messages)> messages{message_index<Messages>()...};
  SampleGroup<Messages...> group_;
};

/// Answers, which are read in the order of their causes. `Answer` has a member cause_us.
template <class Answer>
using InOrderOfCause = TimeOrdered<Answer, &Answer::cause_us>;

/// Receives the groups of one estimator and adds their answers to one `Answers`. Each of `Groups` is an
/// AnswerGroup that has a function `add(cause_us, answers)`. Each run has its own object of this class,
/// because every call for an object must pass the same `seen`.
template <class Answers, class... Groups>
class ReceptionOf : public Reception {
 public:
  [[nodiscard]] bool takes(std::size_t message) const final { return (Groups::has(message) || ...); }
  std::optional<Whole> take(const Frame& frame, std::size_t message, std::int64_t now_us,
                            checks::Observations& seen) final {
    std::optional<Whole> whole;
    const auto try_one = [&]<class Group>(Group& group) {
      if (!Group::has(message) || !group.put(frame)) return;
      whole = group.whole(now_us);
      if (answers_ == nullptr) answers_ = &seen.of<Answers>();  // once, as it is a look-up by type
      group.add(whole->cause_us, *answers_);
    };
    std::apply([&](Groups&... group) { (try_one(group), ...); }, groups_);
    return whole;
  }

 private:
  std::tuple<Groups...> groups_;
  Answers* answers_ = nullptr;
};

}  // namespace canhil::estimators
