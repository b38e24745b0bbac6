// What one run of a campaign leaves behind: the errors after every filter update, from decoded frames alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bench/run/in_process.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::campaign {

/// One filter update: a velocity update, or a fix that was used or gated. Errors of attitude and velocity are
/// those of the first navigation answer that knew of it; all values may be NaN or infinite, as the target
/// sent them.
struct Sample {
  std::int64_t t_us = 0;                                 ///< of the update: its cause's time of validity
  world::Vector3 misalignment = world::Vector3::Zero();  ///< phi, NED [rad]
  world::Euler angles;                                   ///< differences of the Euler angles [rad]
  world::Vector3 v_eb_n = world::Vector3::Zero();        ///< velocity error, NED [m/s]
  double attitude_nees = 0;  ///< 3 degrees of freedom; NaN of a fix: its answer has no covariance
  double nis = 0;            ///< 3 degrees of freedom
  world::Vector3 position = world::Vector3::Zero();  ///< position error, NED [m]; NaN of a velocity update
  double heading_sigma = 0;                          ///< as the target tells it [rad]
  double repairs = 0;                                ///< of the covariance, since the start
};

/// One run of one variant.
struct RunSeries {
  std::uint64_t run = 0;
  run::Ending ending;  ///< a run that did not complete keeps the samples it gave
  std::vector<Sample> samples;
};

/// A number of a sample: an error (signed, SI), the heading error over its sigma, a count, or a normalised
/// error squared.
enum class Quantity : std::uint8_t {
  phi_north,
  phi_east,
  phi_down,
  roll,
  pitch,
  heading,
  v_north,
  v_east,
  v_down,
  p_north,
  p_east,
  p_down,
  heading_over_sigma,
  repairs,
  attitude_nees,
  nis
};
inline constexpr std::array<std::string_view, 16> quantity_names{"phi_north",
                                                                 "phi_east",
                                                                 "phi_down",
                                                                 "roll",
                                                                 "pitch",
                                                                 "heading",
                                                                 "v_north",
                                                                 "v_east",
                                                                 "v_down",
                                                                 "p_north",
                                                                 "p_east",
                                                                 "p_down",
                                                                 "heading_over_sigma",
                                                                 "repairs",
                                                                 "attitude_nees",
                                                                 "nis"};

constexpr std::string_view name(Quantity quantity) {
  return quantity_names[static_cast<std::size_t>(quantity)];
}
/// What reports show a quantity in.
struct Unit {
  std::string_view name;    ///< "mrad", "m/s", "m", or empty
  std::string_view ending;  ///< of keys: "_mrad", "_mps", "_m", or empty
  double factor = 1;        ///< to SI
};
Unit unit_of(Quantity quantity);
double value_of(const Sample& sample, Quantity quantity);

/// The series of a finished run. `truth` is that of its variant.
RunSeries series_of(std::uint64_t run_index, const run::InProcessRun& finished,
                    const world::FlightRecord& truth);

/// Samples as bytes: doubles, little endian, 17 a sample in the order of the struct, t in s.
std::vector<std::uint8_t> encode(std::span<const Sample> samples);
std::vector<Sample> decode(std::span<const std::uint8_t> bytes);

}  // namespace canhil::campaign
