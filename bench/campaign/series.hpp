// What one run of a campaign leaves behind, from decoded frames and the truth alone: a series of numbers for
// each quantity of its estimator's family.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bench/campaign/freshness.hpp"
#include "bench/run/session.hpp"
#include "bench/world/flight_record.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Estimators that are asked for the same quantities. A new one is a name here, its quantities below, and
/// what makes them of a run.
enum class Family : std::uint8_t {
  /// A sample is a filter update: a velocity update, or a fix that was used or gated. Errors of attitude and
  /// velocity are those of the first navigation answer that knew of it.
  alignment,
  /// A sample is 20 ms of the time to go; its time is minus that at which it begins, so that the closest
  /// approach is at 0.
  los_rate,
  /// A sample is a wind answer of a filter that runs.
  wind
};
inline constexpr Family last_family = Family::wind;

/// A number of a sample. Errors are signed (estimated - true), in SI; of the LOS rate, RMS within the sample.
/// Any may be NaN or infinite, as the target sent it; NIS and NEES that are no numbers are infinite.
enum class Quantity : std::uint8_t {
  phi_north,  ///< misalignment, NED
  phi_east,
  phi_down,
  roll,  ///< differences of the Euler angles
  pitch,
  heading,
  v_north,
  v_east,
  v_down,
  p_north,  ///< NaN of a velocity update
  p_east,
  p_down,
  heading_over_sigma,  ///< the error over what the target says of it
  repairs,             ///< of the covariance, since the start
  attitude_nees,       ///< 3 degrees of freedom; NaN of a fix: its answer has no covariance
  nis,                 ///< 3 degrees of freedom; NaN of a fix that the filter did not use
  heading_sigma,       ///< as the target tells it
  los_pitch,           ///< LOS rate in the antenna's axes
  los_yaw,
  los_rate,    ///< of both planes
  los_nis,     ///< mean of the updates' NIS, of 2 degrees of freedom; NaN without an update
  miss_pitch,  ///< of the whole run, as the start's axes divide it; NaN: the target was not passed
  miss_yaw,
  miss,
  wind_along,  ///< wind along the horizontal air velocity, to its right, down
  wind_cross,
  wind_down,
  wind_norm,        ///< of all three
  wind_nis,         ///< 9 degrees of freedom; NaN without an update
  wind_nees,        ///< 3 degrees of freedom
  wind_along_sigma  ///< as the target tells it
};

/// What reports show a quantity in.
struct Unit {
  std::string_view name;    ///< "mrad", "m/s", "m", or empty
  std::string_view ending;  ///< of keys: "_mrad", "_mps", "_m", or empty
  double factor = 1;        ///< to SI
};

struct QuantityInfo {
  std::string_view name;
  Family family = Family::alignment;
  Unit unit;
  int degrees_of_freedom = 0;  ///< of a normalised error squared; 0: none
  bool may_be_untold = false;  ///< NaN tells of nothing wrong: the sample was not asked for it
  bool of_whole_run = false;   ///< the same in all samples: it does not age
  std::string_view only_of{};  ///< the one estimator of the family that tells it; empty: all do
};
std::span<const QuantityInfo> quantities();
const QuantityInfo& info(Quantity quantity);
std::string_view name(Quantity quantity);
Unit unit_of(Quantity quantity);

/// The quantities that a family keeps, in their order; the others follow from them.
std::span<const Quantity> kept(Family family);

/// Samples in order of time.
class Samples {
 public:
  explicit Samples(Family family = Family::alignment) : family_(family) {}

  /// `values`: of kept(family()).
  void add(std::int64_t t_us, std::span<const double> values);

  [[nodiscard]] Family family() const { return family_; }
  [[nodiscard]] std::size_t size() const { return t_us_.size(); }
  [[nodiscard]] bool empty() const { return t_us_.empty(); }
  [[nodiscard]] std::span<const std::int64_t> times() const { return t_us_; }
  /// Of a sample, by its place; NaN: not a quantity of the family.
  [[nodiscard]] double value(std::size_t place, Quantity quantity) const;
  /// The numbers kept of a sample.
  [[nodiscard]] std::span<const double> values(std::size_t place) const;

 private:
  Family family_;
  std::vector<std::int64_t> t_us_;
  std::vector<double> values_;  // sample by sample
};

/// One run of one variant.
struct RunSeries {
  std::uint64_t run = 0;
  run::Ending ending;  ///< a run that did not complete keeps the samples it gave
  Samples samples{};
  Freshness freshness{};
};

/// The family of a scenario's runs.
Family family_of(const scenario::Scenario& scenario);

/// Length of a sample of the LOS rate, in time to go.
inline constexpr std::int64_t los_sample_us = 20'000;

/// The series of a finished run. `truth` is that of its variant, `family` that of its scenario (family_of);
/// no samples where the run has no truth of the family.
RunSeries series_of(std::uint64_t run_index, const run::Collected& finished, const world::FlightRecord& truth,
                    Family family);

/// Samples as bytes: doubles, little endian: t in s and what is kept, sample by sample.
std::vector<std::uint8_t> encode(const Samples& samples);
/// Error: in which way the bytes are no samples of the family.
Result<Samples> decode(std::span<const std::uint8_t> bytes, Family family);

}  // namespace canhil::campaign
