#include "bench/observe/divergence.hpp"

#include <fmt/format.h>

#include <tuple>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/routes.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {
namespace {

constexpr Routes comparable([](const MessageInfo& info) {
  return info.sender == messages::TargetHeartbeat::info.sender &&
         info.id != messages::TargetTiming::info.id && info.id != messages::StepDone::info.id;
});

// The frames of one log that count, one after the other.
class Answers {
 public:
  explicit Answers(LogReader reader) : reader_(std::move(reader)) {}

  // The next one; none at the end.
  Result<std::optional<LogEntry>> next() {
    for (;;) {
      auto entry = reader_.next();
      if (!entry || !*entry) return entry;
      const Frame& frame = (*entry)->frame;
      if (frame.id == messages::Sync::info.id && frame.size == messages::Sync::size) {
        t_s_ = 1e-6 * static_cast<double>(from_frame<messages::Sync>(frame).time_us);
        synchronised_ = true;
      }
      if (synchronised_ && comparable(frame) != Routes::nowhere) return entry;
    }
  }
  [[nodiscard]] double t_s() const { return t_s_; }

 private:
  ClassicLogReader reader_;
  bool synchronised_ = false;
  double t_s_ = 0;
};

template <class Message>
std::string describe_as(const Frame& frame) {
  const Message message = from_frame<Message>(frame);
  std::string text(Message::info.name);
  Message::visit(message, [&](const SignalInfo& signal, const auto& value) {
    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
      text += fmt::format(" {}={}", signal.name, name_of(value));
    } else {
      // To 12 digits: resolves every signal, and hides what binary makes of a decimal fraction.
      text += fmt::format(" {}={:.12g}", signal.name, static_cast<double>(value));
    }
  });
  return text;
}

}  // namespace

Result<Comparison> compare(const std::string& log_a, const std::string& log_b) {
  auto reader_a = LogReader::open(log_a);
  if (!reader_a) return tl::unexpected(reader_a.error());
  auto reader_b = LogReader::open(log_b);
  if (!reader_b) return tl::unexpected(reader_b.error());
  Answers a(std::move(*reader_a));
  Answers b(std::move(*reader_b));
  for (Comparison comparison;; ++comparison.compared) {
    auto next_a = a.next();
    if (!next_a) return tl::unexpected(next_a.error());
    auto next_b = b.next();
    if (!next_b) return tl::unexpected(next_b.error());
    if (!*next_a && !*next_b) return comparison;
    if (*next_a && *next_b && (*next_a)->frame == (*next_b)->frame) continue;
    comparison.first = Divergence{.index = comparison.compared,
                                  .a = std::move(*next_a),
                                  .b = std::move(*next_b),
                                  .t_s = *next_a ? a.t_s() : b.t_s()};
    return comparison;
  }
}

std::string describe(const Frame& frame) {
  std::string text = fmt::format("frame {:03X}, {} bytes", frame.id, frame.size);
  const auto try_one = [&]<class Message>(std::type_identity<Message>) {
    if (frame.id == Message::info.id && frame.size == Message::size &&
        frame.extended == Message::info.extended) {
      text = describe_as<Message>(frame);
    }
  };
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (try_one(std::type_identity<Messages>{}), ...);
  }(std::type_identity<messages::AllMessages>{});
  return text;
}

}  // namespace canhil::observe
