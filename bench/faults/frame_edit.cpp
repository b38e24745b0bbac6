#include "bench/faults/frame_edit.hpp"

#include <cmath>
#include <tuple>
#include <type_traits>

#include "bench/observe/values.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/message.hpp"
#include "dbc/wire/turns.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {
namespace {

template <class Message>
void set_in(Frame& frame, std::string_view name, double value) {
  Message message = from_frame<Message>(frame);
  Message::visit(message, [&](const SignalInfo& signal, auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if (signal.name != name) return;
    if (wire::turns(signal)) value = std::remainder(value, 360);
    if constexpr (std::is_floating_point_v<Member>) {
      member = static_cast<Member>(value);
    } else {
      member = static_cast<Member>(std::llround(value));
    }
  });
  const Rounding rounding = frame.unrounded ? Rounding::none : Rounding::as_on_the_bus;
  frame = to_frame(message, e2e::counter(frame.payload()), rounding);
}

template <class Visit>
void as_message(std::uint32_t id, bool extended, Visit visit) {
  const auto one = [&]<class Message>(std::type_identity<Message>) {
    if (id == Message::info.id && extended == Message::info.extended) visit.template operator()<Message>();
  };
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (one(std::type_identity<Messages>{}), ...);
  }(std::type_identity<messages::AllMessages>{});
}

}  // namespace

std::optional<double> value_of(const Frame& frame, std::string_view signal) {
  for (const observe::Value& value : observe::values_of(frame)) {
    if (value.signal->name == signal) return value.value;
  }
  return std::nullopt;
}

void set(Frame& frame, std::string_view signal, double value) {
  as_message(frame.id, frame.extended, [&]<class Message>() { set_in<Message>(frame, signal, value); });
}

bool is_time(std::string_view signal) {
  return signal == "interval_us" || signal.starts_with("time_of_validity");
}

bool is_validity(const MessageInfo& info, std::string_view name) {
  bool is = false;
  as_message(info.id, info.extended, [&]<class Message>() {
    const Message message{};
    Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
      is = is ||
           (std::is_same_v<std::remove_cvref_t<decltype(member)>, messages::Validity> && signal.name == name);
    });
  });
  return is;
}

void set_counter(Frame& frame, const MessageInfo& message, std::uint8_t counter) {
  if (message.e2e_data_id != 0) e2e::protect({frame.data.data(), frame.size}, message.e2e_data_id, counter);
}

}  // namespace canhil::faults
