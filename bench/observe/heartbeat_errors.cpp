#include "bench/observe/heartbeat_errors.hpp"

#include <fmt/format.h>

#include "bench/observe/heard.hpp"

namespace canhil::observe {

std::string errors_of(const messages::TargetHeartbeat& heartbeat) {
  std::string text;
  const auto add = [&](bool set, std::string_view name) {
    if (set) text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
  };
  add(heartbeat.error_dbc_mismatch != 0, "dbc_mismatch");
  add(heartbeat.error_not_initialised != 0, "not_initialised");
  add(heartbeat.error_input_lost != 0, "input_lost");
  add(heartbeat.error_input_silent != 0, "input_silent");
  add(heartbeat.error_numeric != 0, "numeric");
  add(heartbeat.error_command != 0, "command");
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
  auto beat = heard<messages::TargetHeartbeat>(received);
  if (beat && beat->state != messages::TargetState::fault) beat.reset();
  return beat;
}

}  // namespace canhil::observe
