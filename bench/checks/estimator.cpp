#include "bench/checks/estimator.hpp"

#include <algorithm>
#include <limits>

namespace canhil::estimators {

world::Truths truths_of(const Truth& truth) { return {.flight = truth.flight, .plants = truth.plants}; }

void give_tracks(const Estimator& of, const checks::Observations& seen, const Truth& truth,
                 const quantities::TrackSink& give_away) {
  const auto to_go = world::PlantColumns<1>::find(truth.plants, {"plant.time_to_go"});
  const auto give = [&](quantities::Track track) {
    if (track.quantity->has_time_to_go && to_go) {
      const world::PlantRecord& record = to_go->record();
      for (std::size_t row = 1; row < record.times_us().size(); ++row) {  // the first sample is later than 0
        const std::int64_t t_us = record.times_us()[row];
        if (t_us != record.ended_us) track.to_go.push_back({.t_us = t_us, .to_go_s = to_go->of_row(row)[0]});
      }
    }
    give_away(std::move(track));
  };
  if (truth.flight.is_known()) return of.tracks(seen, truth, give);
  of.tracks(seen, truth, [&](quantities::Track track) {
    if (!track.quantity->white) {
      if (track.kind == quantities::Track::Kind::statistic) return;
      // A loop by index: the iterators of a Spool are constant. NOLINTNEXTLINE(modernize-loop-convert)
      for (std::size_t index = 0; index < track.points.size(); ++index) {
        quantities::TrackPoint& point = track.points[index];
        point.value = std::numeric_limits<double>::quiet_NaN();
        point.truth.reset();
      }
    }
    give(std::move(track));
  });
}

const Estimator* find(std::span<const Estimator* const> estimators, std::string_view name) {
  const auto found = std::ranges::find(estimators, name, [](const Estimator* one) { return one->name; });
  return found == estimators.end() ? nullptr : *found;
}

std::vector<const quantities::Quantity*> quantities_of(std::span<const Estimator* const> estimators) {
  std::vector<const quantities::Quantity*> found;
  const auto add = [&](const quantities::Quantity* quantity) {
    if (std::ranges::find(found, quantity) == found.end()) found.push_back(quantity);
  };
  for (const Estimator* one : estimators) {
    for (const quantities::Quantity* kept : one->layout.kept) add(kept);
    for (const quantities::Derived& derived : one->layout.derived) add(derived.quantity);
    for (const quantities::Quantity* quantity : one->of_runs) add(quantity);
  }
  return found;
}

}  // namespace canhil::estimators
