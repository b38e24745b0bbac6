#include "bench/campaign/series.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "bench/checks/errors.hpp"
#include "bench/world/units.hpp"

namespace canhil::campaign {
namespace {

constexpr std::size_t numbers_per_sample = 17;

void append(std::vector<std::uint8_t>& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
}

double number_at(std::span<const std::uint8_t> bytes, std::size_t place) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{bytes[8 * place + i]} << (8 * i);
  return std::bit_cast<double>(bits);
}

}  // namespace

Unit unit_of(Quantity quantity) {
  if (quantity <= Quantity::heading) return {"mrad", "_mrad", world::units::mrad};
  if (quantity <= Quantity::v_down) return {"m/s", "_mps", 1.0};
  if (quantity <= Quantity::p_down) return {"m", "_m", 1.0};
  return {};
}

double value_of(const Sample& sample, Quantity quantity) {
  switch (quantity) {
    case Quantity::phi_north:
      return sample.misalignment.x();
    case Quantity::phi_east:
      return sample.misalignment.y();
    case Quantity::phi_down:
      return sample.misalignment.z();
    case Quantity::roll:
      return sample.angles.roll;
    case Quantity::pitch:
      return sample.angles.pitch;
    case Quantity::heading:
      return sample.angles.heading;
    case Quantity::v_north:
      return sample.v_eb_n.x();
    case Quantity::v_east:
      return sample.v_eb_n.y();
    case Quantity::v_down:
      return sample.v_eb_n.z();
    case Quantity::p_north:
      return sample.position.x();
    case Quantity::p_east:
      return sample.position.y();
    case Quantity::p_down:
      return sample.position.z();
    case Quantity::heading_over_sigma:
      return sample.angles.heading / sample.heading_sigma;
    case Quantity::repairs:
      return sample.repairs;
    case Quantity::attitude_nees:
      return sample.attitude_nees;
    case Quantity::nis:
      break;
  }
  return sample.nis;
}

RunSeries series_of(std::uint64_t run_index, const run::InProcessRun& finished,
                    const world::FlightRecord& truth) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RunSeries series{.run = run_index, .ending = finished.ending, .samples = {}};
  const checks::Observations& seen = finished.seen;
  const std::vector<checks::NavigationError> errors = checks::navigation_errors(seen, truth);
  const auto add = [&](const auto& update, const Sample& figures) {
    const checks::NavigationError* after = checks::first_after(errors, update.cause_us, update.navigation_us);
    if (after == nullptr) return;
    Sample sample = figures;
    sample.t_us = update.cause_us;
    sample.misalignment = after->misalignment;
    sample.angles = after->angles;
    sample.v_eb_n = after->v_eb_n;
    sample.nis = update.nis;
    series.samples.push_back(sample);
  };
  // One value an update, in order, up to the last one that a navigation answer follows.
  const std::vector<checks::Normalised> nees = checks::attitude_nees(seen, errors);
  for (std::size_t i = 0; i < nees.size(); ++i) {
    const checks::FilterAnswer& update = seen.filter[i];
    Sample figures;
    figures.attitude_nees = nees[i].value;
    figures.position.setConstant(nan);
    figures.heading_sigma = update.attitude_sigma.z();
    add(update, figures);
  }
  for (const checks::FixAnswer& update : seen.fixes) {
    if (!checks::tells_of_its_time(update, truth)) continue;
    Sample figures;
    figures.attitude_nees = nan;
    figures.position = checks::position_error(update, truth);
    figures.heading_sigma = update.heading_sigma;
    figures.repairs = update.repairs;
    add(update, figures);
  }
  return series;
}

std::vector<std::uint8_t> encode(std::span<const Sample> samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size() * numbers_per_sample * sizeof(double));
  for (const Sample& sample : samples) {
    append(bytes, static_cast<double>(sample.t_us) / 1e6);
    for (const double phi : sample.misalignment) append(bytes, phi);
    for (const double angle : {sample.angles.roll, sample.angles.pitch, sample.angles.heading}) {
      append(bytes, angle);
    }
    for (const double v : sample.v_eb_n) append(bytes, v);
    append(bytes, sample.attitude_nees);
    append(bytes, sample.nis);
    for (const double p : sample.position) append(bytes, p);
    append(bytes, sample.heading_sigma);
    append(bytes, sample.repairs);
  }
  return bytes;
}

std::vector<Sample> decode(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t sample_size = numbers_per_sample * sizeof(double);
  std::vector<Sample> samples(bytes.size() / sample_size);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto number = [&](std::size_t place) { return number_at(bytes, i * numbers_per_sample + place); };
    samples[i] = {.t_us = std::llround(number(0) * 1e6),
                  .misalignment = {number(1), number(2), number(3)},
                  .angles = {number(4), number(5), number(6)},
                  .v_eb_n = {number(7), number(8), number(9)},
                  .attitude_nees = number(10),
                  .nis = number(11),
                  .position = {number(12), number(13), number(14)},
                  .heading_sigma = number(15),
                  .repairs = number(16)};
  }
  return samples;
}

}  // namespace canhil::campaign
