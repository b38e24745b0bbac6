#include "bench/drive/initial_state.hpp"

#include <concepts>
#include <string>
#include <type_traits>

#include "bench/nodes/wire_limits.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::drive {

using world::units::deg;

namespace {

template <class Message>
void check(const Message& message, std::string& wrong) {
  Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, double>) {
      const bool inside = member >= signal.minimum && member <= signal.maximum;
      const bool vanishes =
          signal.minimum >= 0 && signal.offset == 0 && member != 0 && member < wire::lsb(signal);
      if (wrong.empty() && (!inside || vanishes))
        wrong = nodes::misfit("initial value", member, Message::info, signal);
    }
  });
}

}  // namespace

InitialState initial_state(const world::NavigationSolution& initial, const scenario::InitialSigma& sigma) {
  const world::Euler angles = world::euler_from(initial.C_bn);
  return {.air = {},
          .navigation = {
              {.latitude_deg = initial.position.latitude / deg, .height_m = initial.position.height},
              {.longitude_deg = world::longitude_deg(initial.position), .position_sigma_m = sigma.position},
              {.velocity_north_mps = initial.v_eb_n.x(), .velocity_east_mps = initial.v_eb_n.y()},
              {.roll_deg = angles.roll / deg,
               .pitch_deg = angles.pitch / deg,
               .heading_deg = angles.heading / deg},
              {.velocity_sigma_mps = sigma.velocity,
               .tilt_sigma_deg = sigma.tilt / deg,
               .heading_sigma_deg = sigma.heading / deg},
              {.velocity_down_mps = initial.v_eb_n.z(), .time_of_validity_us = wrap_us(initial.t_us)}}};
}

InitialAir initial_air(const world::Vector3& rates, const world::Vector3& air_velocity) {
  return {{.rate_x_degps = rates.x() / deg, .rate_y_degps = rates.y() / deg, .rate_z_degps = rates.z() / deg},
          {.air_velocity_x_mps = air_velocity.x(),
           .air_velocity_y_mps = air_velocity.y(),
           .air_velocity_z_mps = air_velocity.z()}};
}

void send(const InitialState& state, nodes::Transmission& out) {
  const auto send_all = [&](const auto&... messages) { (out.send(messages), ...); };
  if (state.air) std::apply(send_all, *state.air);
  std::apply(send_all, state.navigation);
}

Result<void> check_fits(const InitialState& state) {
  std::string wrong;
  const auto check_all = [&](const auto&... messages) { (check(messages, wrong), ...); };
  if (state.air) std::apply(check_all, *state.air);
  std::apply(check_all, state.navigation);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

}  // namespace canhil::drive
