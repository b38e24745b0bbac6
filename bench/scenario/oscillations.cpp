#include "bench/scenario/oscillations.hpp"

#include <array>

#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/motion/oscillation.hpp"

namespace canhil::scenario {
namespace {

constexpr Limits vibration_limits{.least = 0.1, .most = world::highest_vibration};

world::Sinusoid read_sinusoid(Section& section) {
  world::Sinusoid one{.frequency = section.number({"frequency_hz", "Frequency."}, vibration_limits),
                      .acceleration = section.three(
                          {"acceleration_g", "Amplitudes of the specific force, [forward, right, down]."},
                          Limits::between(0, 100)),
                      .angle = section.three(
                          {"angle_mrad", "Amplitudes of the rotation about the axes forward, right, down."},
                          Limits::between(0, 100))};
  const world::Vector3 phase =
      section.three({"phase_deg",
                     "Phases of the axes: specific force and angle are the amplitude times sin(2 pi f t + "
                     "phase). Default: drawn from the seed, for each axis."},
                    Limits::between(-360, 360));
  if (section.has("phase_deg")) one.phase = phase;
  if (!section.has("acceleration_g") && !section.has("angle_mrad"))
    section.reject("acceleration_g", "is missing", "acceleration_g, angle_mrad, or both");
  section.finish();
  return one;
}

world::RandomVibration read_random(Section& section) {
  world::RandomVibration one{
      .from = section.number({"from_hz", "Lower end of the band."}, vibration_limits),
      .to = section.number({"to_hz", "Upper end of the band."}, vibration_limits),
      .psd = section.three(
          {"psd_g2phz", "One-sided power spectral density of the specific force, [forward, right, down]."},
          Limits::between(0, 10)),
      .lines =
          section
              .optional_integer({"lines",
                                 "Number of sinusoids that represent the band, up to 200. Default: 20. The "
                                 "time to compute the truth grows with it."},
                                1)
              .value_or(20)};
  constexpr std::int64_t most_lines = 200;
  if (one.lines > most_lines) section.reject("lines", "are too many", "at most 200");
  if (section.has("from_hz") && section.has("to_hz") && one.from >= one.to)
    section.reject("to_hz", "is not above from_hz", "a frequency above it");
  if (!section.has("psd_g2phz")) section.missing("psd_g2phz", "a number, or an array of three");
  section.finish();
  return one;
}

void read_vibration(Section section, world::OscillationModel& model) {
  const bool sine = section.has("sine"), random = section.has("random");
  if (!sine && !random)
    section.missing("sine", "at least one [[truth.vibration.sine]] or [[truth.vibration.random]]");
  if (sine)
    for (Section& one : section.tables("sine")) model.sinusoids.push_back(read_sinusoid(one));
  if (random)
    for (Section& one : section.tables("random")) model.random.push_back(read_random(one));
  section.finish();
}

world::SeaModel read_sea(Section section) {
  constexpr std::array<std::string_view, 2> spectra{"pierson_moskowitz", "jonswap"};
  enum class Spectrum : std::uint8_t { pierson_moskowitz, jonswap };
  const Limits periods = Limits::between(1, 60), damping = Limits::between(0.01, 2);
  world::SeaModel sea{.significant_height = section.number(
                          {"significant_height_m",
                           "Significant wave height: four standard deviations of the surface's elevation."},
                          Limits::between(0, 20)),
                      .peak_period = section.number({"peak_period_s", "Period of the peak of the spectrum."},
                                                    Limits::between(2, 30))};
  const auto spectrum = read_enum<Spectrum>(section,
                                            {"spectrum",
                                             "Shape of the spectrum. `pierson_moskowitz`: a fully developed "
                                             "sea; `jonswap`: a sea with a limited fetch."},
                                            spectra, Spectrum::pierson_moskowitz);
  if (spectrum != Spectrum::jonswap)
    section.refuse("peakedness", "has no effect here", "spectrum = \"jonswap\" beside it");
  const double peakedness =
      section.number({"peakedness", "Peak enhancement factor of `jonswap`."}, Limits::between(1, 10), 3.3);
  if (spectrum == Spectrum::jonswap) sea.peakedness = peakedness;
  sea.from = section.number({"from_deg", "Direction from which the waves come: 0 north, 90 east."},
                            Limits::between(-180, 360));
  sea.length = section.number({"length_m",
                               "Length of the vessel. It follows waves that are much longer: heave is the "
                               "elevation / (1 + (length / wavelength)^2)."},
                              Limits::between(0.1, 500));
  sea.roll_period =
      section.number({"roll_period_s", "Natural period of the roll."}, periods, sea.roll_period);
  sea.roll_damping =
      section.number({"roll_damping", "Damping ratio of the roll."}, damping, sea.roll_damping);
  sea.pitch_period =
      section.number({"pitch_period_s", "Natural period of the pitch."}, periods, sea.pitch_period);
  sea.pitch_damping =
      section.number({"pitch_damping", "Damping ratio of the pitch."}, damping, sea.pitch_damping);
  section.finish();
  return sea;
}

}  // namespace

std::shared_ptr<const world::OscillationModel> read_oscillations(Section& truth, bool built_in) {
  if (!built_in) {
    for (const char* table : {"vibration", "sea"})
      truth.refuse(table, "cannot be added to this trajectory", "it with a built-in trajectory only");
    return nullptr;
  }
  auto model = std::make_shared<world::OscillationModel>();
  auto vibration = truth.optional_table("vibration");
  if (vibration) read_vibration(*vibration, *model);
  auto sea = truth.optional_table("sea");
  if (sea) model->sea = read_sea(*sea);
  if (!vibration && !sea) return nullptr;
  return model;
}

}  // namespace canhil::scenario
