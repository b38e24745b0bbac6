#include "bench/nodes/wire_limits.hpp"

#include <fmt/format.h>

#include <cmath>

namespace canhil::nodes {

std::string misfit(std::string_view what, double value, const MessageInfo& message,
                   const SignalInfo& signal) {
  return fmt::format("{} {:g} {} does not fit into {}.{}, expected {:g} to {:g} in steps of {:g}", what,
                     value, signal.unit, message.name, signal.name, signal.minimum, signal.maximum,
                     wire::lsb(signal));
}

Result<void> check_interval(std::string_view what, std::int64_t interval_us, const MessageInfo& message,
                            std::span<const SignalInfo> signals) {
  const auto interval = static_cast<double>(interval_us);
  for (const SignalInfo& signal : signals) {
    if (signal.name != "interval_us") continue;
    const double lsb = wire::lsb(signal);
    const bool between_steps = lsb != 0 && interval / lsb != std::nearbyint(interval / lsb);
    if (interval > signal.maximum || between_steps) return failure(misfit(what, interval, message, signal));
  }
  return {};
}

}  // namespace canhil::nodes
