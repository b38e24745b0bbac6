#include "bench/run/wire_limits.hpp"

#include <fmt/format.h>

#include <cmath>
#include <concepts>

namespace canhil::run {
namespace {

std::string complaint(std::string_view what, double value, const MessageInfo& message,
                      const SignalInfo& signal) {
  return fmt::format("{} {:g} {} does not fit into {}.{}, expected {:g} to {:g} in steps of {:g}", what,
                     value, signal.unit, message.name, signal.name, signal.minimum, signal.maximum,
                     wire::lsb(signal));
}

template <class Message>
void check(const Message& message, std::string& wrong) {
  Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, double>) {
      const bool inside = member >= signal.minimum && member <= signal.maximum;
      const bool vanishes =
          signal.minimum >= 0 && signal.offset == 0 && member != 0 && member < wire::lsb(signal);
      if (wrong.empty() && (!inside || vanishes))
        wrong = complaint("initial value", member, Message::info, signal);
    }
  });
}

}  // namespace

Result<void> check_fits(const InitialState& state) {
  std::string wrong;
  std::apply([&](const auto&... messages) { (check(messages, wrong), ...); }, state);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

Result<void> check_fits_imu_interval(std::int64_t interval_us) {
  using messages::SlaveImuStatus;
  const auto interval = static_cast<double>(interval_us);
  const SlaveImuStatus status{.interval_us = interval};
  std::string wrong;
  SlaveImuStatus::visit(status, [&](const SignalInfo& signal, const auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, double>) {
      const double lsb = wire::lsb(signal);
      const bool between_steps = lsb != 0 && member / lsb != std::nearbyint(member / lsb);
      if (member > signal.maximum || between_steps) {
        wrong = complaint("IMU interval", member, SlaveImuStatus::info, signal);
      }
    }
  });
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

}  // namespace canhil::run
