#include "bench/plant/published.hpp"

#include <algorithm>
#include <memory>

#include "bench/plant/glide/glide.hpp"
#include "bench/plant/glide/read.hpp"
#include "bench/plant/setup.hpp"
#include "bench/plant/simulation.hpp"

namespace canhil::plant {

std::optional<world::Vector3> published_wind(std::string_view season, double height) {
  const auto found = std::ranges::find(glide::season_names, season);
  if (found == glide::season_names.end()) return std::nullopt;
  return glide::WindProfile(static_cast<glide::Season>(found - glide::season_names.begin())).at(height);
}

const world::PlantRecord& published_flight() {
  static const auto facts = facts_of(glide::table, std::make_shared<glide::GliderPlan>(glide::Settings{}));
  static const auto flown = [] {
    constexpr std::int64_t duration_us = 100'000'000;
    auto simulation = Simulation::begin(*facts.setup, {}, {.start = {}, .duration_us = duration_us});
    (*simulation)->advance(duration_us);
    return std::move(*simulation);
  }();
  return flown->record();
}

}  // namespace canhil::plant
