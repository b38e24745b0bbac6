#include "bench/protocol/heartbeat_errors.hpp"

#include <fmt/format.h>

#include "bench/protocol/decode_from_target.hpp"

namespace canhil::protocol {

std::string errors_of(const messages::TargetHeartbeat& heartbeat) {
  constexpr std::string_view error = "error_";
  std::string text;
  messages::TargetHeartbeat::visit(heartbeat, [&](const SignalInfo& signal, const auto& value) {
    if (signal.name.starts_with(error) && static_cast<int>(value) != 0)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", signal.name.substr(error.size()));
  });
  return text.empty() ? "none" : text;
}

std::string fault_of(const messages::TargetHeartbeat& heartbeat) {
  const std::string_view known = name_of(heartbeat.estimator);
  const std::string estimator =
      known.empty() ? fmt::format("estimator {}", static_cast<int>(heartbeat.estimator)) : std::string(known);
  return fmt::format("the target reported a fault of its {}, its errors: {}", estimator,
                     errors_of(heartbeat));
}

std::optional<messages::TargetHeartbeat> fault_in(const Received& received) {
  auto beat = decode_from_target<messages::TargetHeartbeat>(received);
  if (beat && beat->state != messages::TargetState::fault) beat.reset();
  return beat;
}

}  // namespace canhil::protocol
