#include "bench/observe/values.hpp"

#include <fmt/format.h>

#include <tuple>
#include <type_traits>

#include "dbc/wire/routes.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {
namespace {

constexpr Routes answers([](const MessageInfo& info) {
  return is_targets(info) && info.id != messages::TargetTiming::info.id &&
         info.id != messages::StepDone::info.id;
});

// Calls visit.operator()<Message>() for the message of a frame; makes no call if the frame matches no
// message.
template <class Visit>
void as_message(const Frame& frame, Visit visit) {
  const auto try_one = [&]<class Message>(std::type_identity<Message>) {
    if (frame.id == Message::info.id && frame.size == Message::size &&
        frame.extended == Message::info.extended) {
      visit.template operator()<Message>();
    }
  };
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (try_one(std::type_identity<Messages>{}), ...);
  }(std::type_identity<messages::AllMessages>{});
}

}  // namespace

bool is_answer(const Frame& frame) { return answers(frame) != Routes::nowhere; }

std::vector<Value> values_of(const Frame& frame) {
  std::vector<Value> values;
  as_message(frame, [&]<class Message>() {
    const Message message = from_frame<Message>(frame);
    Message::visit(message, [&](const SignalInfo& signal, const auto& value) {
      const auto number = static_cast<double>(value);
      if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
        values.push_back({&signal, number, name_of(value)});
      } else {
        values.push_back({&signal, number, {}});
      }
    });
  });
  return values;
}

std::string to_text(const Value& value) {
  // 12 digits resolve every signal and hide the binary representation of decimal fractions.
  return value.enumerator.empty() ? fmt::format("{:.12g}", value.value) : std::string(value.enumerator);
}

std::vector<const SignalInfo*> signals_of(const MessageInfo& message) {
  Frame frame;
  frame.id = message.id;
  frame.extended = message.extended;
  frame.size = message.size;
  std::vector<const SignalInfo*> signals;
  for (const Value& value : values_of(frame)) signals.push_back(value.signal);
  return signals;
}

const SignalInfo* signal_of(const MessageInfo& message, std::string_view name) {
  for (const SignalInfo* signal : signals_of(message)) {
    if (signal->name == name) return signal;
  }
  return nullptr;
}

std::string_view message_of(const Frame& frame) {
  std::string_view name;
  as_message(frame, [&]<class Message>() { name = Message::info.name; });
  return name;
}

}  // namespace canhil::observe
