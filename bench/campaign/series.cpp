#include "bench/campaign/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#include "bench/checks/errors.hpp"
#include "bench/checks/los.hpp"
#include "bench/checks/wind.hpp"
#include "bench/world/units.hpp"

namespace canhil::campaign {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr Unit mrad{"mrad", "_mrad", world::units::mrad}, mps{"m/s", "_mps", 1}, m{"m", "_m", 1}, none{},
    mradps{"mrad/s", "_mradps", world::units::mrad};

// In the order of the enumeration.
constexpr std::array infos{
    QuantityInfo{.name = "phi_north", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "phi_east", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "phi_down", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "roll", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "pitch", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "heading", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "v_north", .family = Family::alignment, .unit = mps},
    QuantityInfo{.name = "v_east", .family = Family::alignment, .unit = mps},
    QuantityInfo{.name = "v_down", .family = Family::alignment, .unit = mps},
    QuantityInfo{.name = "p_north",
                 .family = Family::alignment,
                 .unit = m,
                 .may_be_untold = true,
                 .only_of = "inflight_alignment"},
    QuantityInfo{.name = "p_east",
                 .family = Family::alignment,
                 .unit = m,
                 .may_be_untold = true,
                 .only_of = "inflight_alignment"},
    QuantityInfo{.name = "p_down",
                 .family = Family::alignment,
                 .unit = m,
                 .may_be_untold = true,
                 .only_of = "inflight_alignment"},
    QuantityInfo{.name = "heading_over_sigma", .family = Family::alignment, .unit = none},
    QuantityInfo{
        .name = "repairs", .family = Family::alignment, .unit = none, .only_of = "inflight_alignment"},
    QuantityInfo{.name = "attitude_nees",
                 .family = Family::alignment,
                 .unit = none,
                 .degrees_of_freedom = 3,
                 .may_be_untold = true,
                 .only_of = "transfer_alignment"},
    QuantityInfo{.name = "nis",
                 .family = Family::alignment,
                 .unit = none,
                 .degrees_of_freedom = 3,
                 .may_be_untold = true},
    QuantityInfo{.name = "heading_sigma", .family = Family::alignment, .unit = mrad},
    QuantityInfo{.name = "los_pitch", .family = Family::los_rate, .unit = mradps},
    QuantityInfo{.name = "los_yaw", .family = Family::los_rate, .unit = mradps},
    QuantityInfo{.name = "los_rate", .family = Family::los_rate, .unit = mradps},
    QuantityInfo{.name = "los_nis", .family = Family::los_rate, .unit = none, .may_be_untold = true},
    QuantityInfo{.name = "miss_pitch", .family = Family::los_rate, .unit = m, .of_whole_run = true},
    QuantityInfo{.name = "miss_yaw", .family = Family::los_rate, .unit = m, .of_whole_run = true},
    QuantityInfo{.name = "miss", .family = Family::los_rate, .unit = m, .of_whole_run = true},
    QuantityInfo{.name = "wind_along", .family = Family::wind, .unit = mps},
    QuantityInfo{.name = "wind_cross", .family = Family::wind, .unit = mps},
    QuantityInfo{.name = "wind_down", .family = Family::wind, .unit = mps},
    QuantityInfo{.name = "wind_norm", .family = Family::wind, .unit = mps},
    QuantityInfo{.name = "wind_nis",
                 .family = Family::wind,
                 .unit = none,
                 .degrees_of_freedom = 9,
                 .may_be_untold = true},
    QuantityInfo{.name = "wind_nees", .family = Family::wind, .unit = none, .degrees_of_freedom = 3},
    QuantityInfo{.name = "wind_along_sigma", .family = Family::wind, .unit = mps}};
static_assert(infos.size() == static_cast<std::size_t>(Quantity::wind_along_sigma) + 1);

using enum Quantity;
constexpr std::array alignment_kept{phi_north, phi_east, phi_down,      roll,          pitch, heading,
                                    v_north,   v_east,   v_down,        attitude_nees, nis,   p_north,
                                    p_east,    p_down,   heading_sigma, repairs};
constexpr std::array los_kept{los_pitch, los_yaw, los_nis, miss_pitch, miss_yaw};
constexpr std::array wind_kept{wind_along, wind_cross, wind_down, wind_nis, wind_nees, wind_along_sigma};

void append(std::vector<std::uint8_t>& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
}

double number_at(std::span<const std::uint8_t> bytes, std::size_t place) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{bytes[8 * place + i]} << (8 * i);
  return std::bit_cast<double>(bits);
}

/// A normalised error squared that was told, so that NaN is left to what was not.
double told(double normalised) {
  return std::isnan(normalised) ? std::numeric_limits<double>::infinity() : normalised;
}

/// Figures of an update beside those of the navigation answer that follows it.
struct UpdateFigures {
  double attitude_nees = nan;
  double nis = nan;
  world::Vector3 position = world::Vector3::Constant(nan);
  double heading_sigma = 0;
  double repairs = 0;
};

Samples alignment_samples(const checks::Observations& seen, const world::FlightRecord& truth) {
  Samples samples(Family::alignment);
  const auto add = [&](const std::vector<checks::NavigationError>& errors, const auto& update,
                       const UpdateFigures& figures) {
    const checks::NavigationError* after = checks::first_after(errors, update.cause_us, update.navigation_us);
    if (after == nullptr) return;
    const auto& [t_us, angles, v, phi] = *after;
    const world::Vector3& p = figures.position;
    const std::array<double, alignment_kept.size()> values{
        phi.x(),        phi.y(), phi.z(), angles.roll, angles.pitch,
        angles.heading, v.x(),   v.y(),   v.z(),       figures.attitude_nees,
        figures.nis,    p.x(),   p.y(),   p.z(),       figures.heading_sigma,
        figures.repairs};
    samples.add(update.cause_us, values);
  };
  // One value an update, in order, up to the last one that a navigation answer follows.
  const auto transfer = checks::navigation_errors(seen.navigation, truth);
  const std::vector<checks::Normalised> nees = checks::attitude_nees(seen, transfer);
  for (std::size_t i = 0; i < nees.size(); ++i) {
    const checks::FilterAnswer& update = seen.filter[i];
    add(transfer, update,
        {.attitude_nees = told(nees[i].value),
         .nis = told(update.nis),
         .heading_sigma = update.attitude_sigma.z()});
  }
  const auto inflight = checks::navigation_errors(seen.fix_navigation, truth);
  for (const checks::FixAnswer& update : seen.fixes) {
    if (!checks::tells_of_its_time(update, truth)) continue;
    add(inflight, update,
        {.nis = checks::used(update.outcome) ? told(update.nis) : nan,
         .position = checks::position_error(update, truth),
         .heading_sigma = update.heading_sigma,
         .repairs = static_cast<double>(update.repairs)});
  }
  return samples;
}

/// What falls into one sample of the LOS rate.
struct LosBin {
  double pitch_squares = 0, yaw_squares = 0, nis_sum = 0;
  int rates = 0, updates = 0;
};

Samples los_samples(const checks::Observations& seen, const world::EngagementRecord& engagement) {
  std::map<std::int64_t, LosBin> bins;  // by -(time to go), in samples
  const auto bin_of = [&](double time_to_go) -> LosBin& {
    return bins[-static_cast<std::int64_t>(
        std::floor(time_to_go * 1e6 / static_cast<double>(los_sample_us)))];
  };
  for (const checks::LosError& error : checks::los_errors(seen, engagement)) {
    LosBin& bin = bin_of(error.time_to_go);
    bin.pitch_squares += error.rate.pitch * error.rate.pitch;
    bin.yaw_squares += error.rate.yaw * error.rate.yaw;
    ++bin.rates;
  }
  for (const checks::Normalised& update : checks::los_nis(seen)) {
    const world::EngagementTruth* truth = engagement.at(update.t_us);
    if (truth == nullptr) continue;
    LosBin& bin = bin_of(truth->time_to_go());
    bin.nis_sum += update.value;
    ++bin.updates;
  }
  const world::Vector3 miss_n = engagement.miss_n.value_or(world::Vector3::Constant(nan));
  Samples samples(Family::los_rate);
  for (const auto& [place, bin] : bins) {
    if (bin.rates == 0) continue;
    const std::array<double, los_kept.size()> values{
        std::sqrt(bin.pitch_squares / bin.rates), std::sqrt(bin.yaw_squares / bin.rates),
        bin.updates > 0 ? told(bin.nis_sum / bin.updates) : nan, miss_n.z(), miss_n.y()};
    samples.add((place - 1) * los_sample_us, values);
  }
  return samples;
}

Samples wind_samples(const checks::Observations& seen, const world::GlideRecord& glide) {
  Samples samples(Family::wind);
  const auto errors = checks::wind_errors(seen, glide);
  const auto nees = checks::wind_nees(seen, glide);  // one for each error
  auto answer = seen.wind.begin();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    while (!answer->started || answer->cause_us != errors[i].t_us) ++answer;
    const bool updated = answer->outcome == messages::WindOutcome::updated;
    const std::array<double, wind_kept.size()> values{
        errors[i].along_track, errors[i].cross_track,
        errors[i].error_n.z(), updated ? told(answer->nis) : nan,
        told(nees[i].value),   answer->along_track_sigma};
    samples.add(errors[i].t_us, values);
    ++answer;
  }
  return samples;
}

Samples samples_of(const run::Collected& finished, const world::FlightRecord& truth, Family family) {
  const auto& [engagement, glide] = finished.own_truth;
  switch (family) {
    case Family::los_rate:
      return engagement ? los_samples(finished.seen, *engagement) : Samples(family);
    case Family::wind:
      return glide ? wind_samples(finished.seen, *glide) : Samples(family);
    case Family::alignment:
      break;
  }
  return alignment_samples(finished.seen, truth);
}

}  // namespace

std::span<const QuantityInfo> quantities() { return infos; }
const QuantityInfo& info(Quantity quantity) { return infos[static_cast<std::size_t>(quantity)]; }
std::string_view name(Quantity quantity) { return info(quantity).name; }
Unit unit_of(Quantity quantity) { return info(quantity).unit; }

std::span<const Quantity> kept(Family family) {
  switch (family) {
    case Family::los_rate:
      return los_kept;
    case Family::wind:
      return wind_kept;
    case Family::alignment:
      break;
  }
  return alignment_kept;
}

void Samples::add(std::int64_t t_us, std::span<const double> values) {
  assert(values.size() == kept(family_).size());
  t_us_.push_back(t_us);
  values_.insert(values_.end(), values.begin(), values.end());
}

std::span<const double> Samples::values(std::size_t place) const {
  const std::size_t width = kept(family_).size();
  return std::span(values_).subspan(place * width, width);
}

double Samples::value(std::size_t place, Quantity quantity) const {
  const auto of = [&](Quantity one) { return value(place, one); };
  switch (quantity) {
    case heading_over_sigma:
      return of(heading) / of(heading_sigma);
    case los_rate:
      return std::sqrt((of(los_pitch) * of(los_pitch) + of(los_yaw) * of(los_yaw)) / 2);
    case miss:
      return std::hypot(of(miss_pitch), of(miss_yaw));
    case wind_norm:
      return std::hypot(of(wind_along), of(wind_cross), of(wind_down));
    default:
      break;
  }
  const auto columns = kept(family_);
  const auto found = std::ranges::find(columns, quantity);
  return found == columns.end() ? nan : values(place)[static_cast<std::size_t>(found - columns.begin())];
}

// By what the target is asked for: a scenario may have several truths.
Family family_of(const scenario::Scenario& scenario) {
  if (scenario.runs("los_rate")) return Family::los_rate;
  if (scenario.runs("wind")) return Family::wind;
  return Family::alignment;
}

RunSeries series_of(std::uint64_t run_index, const run::Collected& finished, const world::FlightRecord& truth,
                    Family family) {
  return {.run = run_index, .ending = finished.ending, .samples = samples_of(finished, truth, family)};
}

std::vector<std::uint8_t> encode(const Samples& samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size() * (1 + kept(samples.family()).size()) * sizeof(double));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    append(bytes, static_cast<double>(samples.times()[i]) / 1e6);
    for (const double value : samples.values(i)) append(bytes, value);
  }
  return bytes;
}

Result<Samples> decode(std::span<const std::uint8_t> bytes, Family family) {
  constexpr double latest_s = 1e9;
  const std::size_t width = 1 + kept(family).size(), size = width * sizeof(double);
  if (bytes.size() % size != 0)
    return failure(fmt::format("has {} bytes of samples of {} each", bytes.size(), size));
  Samples samples(family);
  std::vector<double> values(width - 1);
  for (std::size_t i = 0; i < bytes.size() / size; ++i) {
    for (std::size_t place = 1; place < width; ++place)
      values[place - 1] = number_at(bytes, i * width + place);
    const double t_s = number_at(bytes, i * width);
    if (!(std::abs(t_s) <= latest_s)) return failure(fmt::format("has a sample at {} s", t_s));
    samples.add(std::llround(t_s * 1e6), values);
  }
  return samples;
}

}  // namespace canhil::campaign
