#include "bench/observe/divergence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "bench/observe/values.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/routes.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {
namespace {

// The frames of one log that are compared, in order.
class Answers {
 public:
  explicit Answers(LogReader reader) : reader_(std::move(reader)) {}

  // The next compared frame; none at the end of the log.
  Result<std::optional<LogEntry>> next() {
    for (;;) {
      auto entry = reader_.next();
      if (!entry || !*entry) return entry;
      const Frame& frame = (*entry)->frame;
      if (frame.id == messages::Sync::info.id && frame.size == messages::Sync::size) {
        t_s_ = 1e-6 * static_cast<double>(from_frame<messages::Sync>(frame).time_us);
        synchronised_ = true;
      }
      if (synchronised_ && is_answer(frame)) return entry;
    }
  }
  [[nodiscard]] double t_s() const { return t_s_; }

 private:
  ClassicLogReader reader_;
  bool synchronised_ = false;
  double t_s_ = 0;
};

bool is_protected(const Frame& frame) {
  const MessageInfo* info = messages::find_message(frame.id);
  return info != nullptr && info->e2e_data_id != 0;
}

bool crc_is_right(const Frame& frame) {
  return frame.data[0] == e2e::crc(frame.payload(), messages::find_message(frame.id)->e2e_data_id);
}

// The first signal of the end-to-end protection in which two frames of a message differ; none: they agree. Of
// the CRCs, only the validity is compared: the CRCs of different values differ.
std::optional<std::string> departure_of_protection(const Frame& a, const Frame& b) {
  if (!is_protected(a)) return std::nullopt;
  const auto right = [](const Frame& frame) { return crc_is_right(frame) ? "right" : "wrong"; };
  if (crc_is_right(a) != crc_is_right(b))
    return fmt::format("{}.e2e_crc is {} in one, {} in the other", message_of(a), right(a), right(b));
  const int of_a = e2e::counter(a.payload()), of_b = e2e::counter(b.payload());
  if (of_a == of_b) return std::nullopt;
  return fmt::format("{}.e2e_counter is {} in one, {} in the other", message_of(a), of_a, of_b);
}

// The first signal in which two frames of a message differ by more than `steps` steps; none: they agree.
std::optional<std::string> departure(const Frame& a, const Frame& b, double steps) {
  const std::vector<Value> of_a = values_of(a), of_b = values_of(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const double step = wire::lsb(*of_a[i].signal);
    const double tolerance =
        step == 1 ? 0 : (steps + 0.5) * step;  // values are multiples of the step, except for rounding
    const bool equal = of_a[i].value == of_b[i].value;
    if (equal || (steps > 0 && std::abs(of_a[i].value - of_b[i].value) <= tolerance)) continue;
    return fmt::format("{}.{} is {} in one, {} in the other", message_of(a), of_a[i].signal->name,
                       to_text(of_a[i]), to_text(of_b[i]));
  }
  return departure_of_protection(a, b);
}

bool same_message(const Frame& a, const Frame& b) {
  return a.id == b.id && a.size == b.size && a.extended == b.extended && !message_of(a).empty();
}

}  // namespace

Result<Comparison> compare(const std::string& log_a, const std::string& log_b, double steps) {
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
    std::optional<std::string> signal;
    if (*next_a && *next_b) {
      const Frame &frame_a = (*next_a)->frame, &frame_b = (*next_b)->frame;
      if (frame_a == frame_b) continue;
      if (same_message(frame_a, frame_b)) {
        signal = departure(frame_a, frame_b, steps);
        if (!signal && steps > 0) continue;
      }
    }
    comparison.first = Divergence{.index = comparison.compared,
                                  .a = std::move(*next_a),
                                  .b = std::move(*next_b),
                                  .t_s = *next_a ? a.t_s() : b.t_s(),
                                  .signal = signal.value_or("")};
    return comparison;
  }
}

std::string describe(const Frame& frame) {
  const std::string_view message = message_of(frame);
  if (message.empty()) return fmt::format("frame {:03X}, {} bytes", frame.id, frame.size);
  std::string text(message);
  if (is_protected(frame))
    text += fmt::format(" e2e_counter={}{}", e2e::counter(frame.payload()),
                        crc_is_right(frame) ? "" : " (wrong CRC)");
  for (const Value& value : values_of(frame))
    text += fmt::format(" {}={}", value.signal->name, to_text(value));
  return text;
}

}  // namespace canhil::observe
