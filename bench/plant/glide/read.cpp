#include "bench/plant/glide/read.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/plant/glide/glide.hpp"
#include "bench/plant/setup.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::plant::glide {
namespace {

using scenario::Limits;
using scenario::read_enum;
using scenario::ReleaseError;
using scenario::Section;

WindProfile read_profile(Section& section) {
  if (section.has("season") || !section.has("steady_mps")) {
    if (section.has("steady_mps")) section.reject("steady_mps", "is given beside season", "one of the two");
    section.optional("steady_mps");
    return WindProfile(read_enum<Season>(
        section, {"season", "Month whose mean wind is used. The wind depends on the height."}, season_names));
  }
  section.optional("season");
  return WindProfile(section.three({"steady_mps",
                                    "Constant wind [N, E, D], in place of `season`. One of the keys "
                                    "`season` and `steady_mps` is required."},
                                   Limits::between(-150, 150)));
}

void read_wind(Section section, Settings& plan) {
  plan.wind = read_profile(section);
  plan.gusts.sigma =
      section.number({"gust_sigma_mps", "1-sigma of Dryden gusts."}, Limits::between(0, 20), 0);
  if (!section.has("gust_sigma_mps"))
    section.refuse("gust_time_s", "has no effect alone", "gust_sigma_mps beside it");
  plan.gusts.time =
      section.number({"gust_time_s", "Correlation time of the gusts. Only together with `gust_sigma_mps`."},
                     Limits::above(0), plan.gusts.time);
  section.finish();
}

void read_airframe(Section section, Settings& plan) {
  CoefficientErrorModel& errors = plan.coefficients;
  errors.level = section.number(
      {"coefficient_error_percent",
       "1-sigma of the errors by which the true aerodynamic coefficients differ from the filter's model."},
      Limits::between(0, 100), 0);
  errors.kind = read_enum<ErrorKind>(
      section,
      {"coefficient_error",
       "How the errors change with time. `white`: drawn again at each step of the truth; `held`: drawn again "
       "every `hold_ms`; `markov`: correlated over `markov_time_s`; `constant`: drawn once for each run."},
      error_kind_names, ErrorKind::held);
  const std::int64_t hold_us = section.time_us({"hold_ms", "Time for which `held` errors stay constant."},
                                               Limits::between(10, 1e6), 50);
  if (errors.kind != ErrorKind::markov)
    section.refuse("markov_time_s", "has no effect here", "coefficient_error = \"markov\" beside it");
  const std::int64_t markov_us =
      section.time_us({"markov_time_s", "Correlation time of `markov` errors. Refused with other kinds."},
                      Limits::between(0.01, 1e4), 1);
  errors.time_us = errors.kind == ErrorKind::markov ? markov_us : hold_us;
  const std::vector<std::string> scopes{"term", "total"};
  errors.per_part =
      section.one_of(
          {"per",
           "`term`: one error for each term of a coefficient; `total`: one error for the whole coefficient."},
          scopes, "term") == "term";
  const std::vector<std::string> reaches{"forces_and_moments", "forces"};
  errors.moments =
      section.one_of({"of", "Coefficients that have the errors."}, reaches, reaches[0]) == reaches[0];
  plan.density_error = section.number({"density_error_percent",
                                       "Deviation of the true air density from the standard density that the "
                                       "filter assumes; positive: the air is denser."},
                                      Limits::between(-50, 50), 0);
  section.finish();
}

ReleaseError read_release(Section section) {
  const ReleaseError error{
      .air_velocity =
          section.number({"air_velocity_sigma_mps",
                          "The target receives an initial air velocity with a random error of this 1-sigma."},
                         Limits::between(0, 50), 0),
      .velocity =
          section.number({"velocity_sigma_mps",
                          "The target receives an initial velocity with a random error of this 1-sigma."},
                         Limits::between(0, 50), 0),
      .attitude =
          section.number({"attitude_sigma_deg",
                          "The target receives an initial attitude with a random error of this 1-sigma."},
                         Limits::between(0, 30), 0),
      .rate = section.number(
          {"rate_sigma_degps", "The target receives initial body rates with random errors of this 1-sigma."},
          Limits::between(0, 30), 0)};
  section.finish();
  return error;
}

constexpr std::array<std::string_view, 2> further_tables{"wind", "airframe"};
constexpr std::array<std::string_view, 4> shows{"wind.north", "wind.east", "wind.down", "plant.height"};

scenario::PlantFacts read_glide(Section& root, Section& section, const scenario::Binding& binding) {
  Settings settings;
  if (!binding.handshake)
    section.refuse("initial_error", "has no effect: a target with a mapping is not told this state",
                   "no such table");
  settings.heading = section.number({"heading_deg", "Heading at the release."}, Limits::between(-180, 360));
  settings.speed = section.number({"speed_mps", "Speed at the release."}, Limits::between(80, 300));
  settings.height = section.number({"height_m", "Height at the release."}, Limits::between(100, 15'000));
  ReleaseError release;
  if (auto errors = section.optional_table("initial_error")) release = read_release(*errors);
  section.finish();
  read_wind(root.table("wind"), settings);
  if (auto airframe = root.optional_table("airframe")) read_airframe(*airframe, settings);
  auto facts = facts_of(table, std::make_shared<GliderPlan>(settings));
  facts.release = release;
  return facts;
}

}  // namespace

constinit const scenario::PlantTable table{.key = "glide",
                                           .further_tables = further_tables,
                                           .about = "For an unpowered glider.",
                                           .shows = shows,
                                           .sampled_every_us = Glider::step_us,
                                           .read = read_glide};

}  // namespace canhil::plant::glide
