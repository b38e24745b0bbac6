#include "bench/run/initial_state.hpp"

#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::run {

using world::units::deg;

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

}  // namespace canhil::run
