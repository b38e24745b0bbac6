#include "bench/report/series.hpp"

#include <iterator>

#include "bench/checks/probability.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/report/series_bars.hpp"
#include "bench/report/thinned.hpp"

namespace canhil::report {
namespace {

using quantities::Told;
using quantities::Track;

std::optional<double> in(const quantities::Unit& unit, const std::optional<double>& value) {
  return value ? std::optional(*value / unit.factor) : std::nullopt;
}

Series::Kind kind_of(const Track& track) {
  switch (track.kind) {
    case Track::Kind::innovation:
      return Series::Kind::innovation;
    case Track::Kind::statistic:
      return Series::Kind::statistic;
    case Track::Kind::error:
      break;
  }
  return Series::Kind::error;
}

// The pictures of one estimator: estimates beside the truth first.
class Pictures {
 public:
  Pictures(std::string_view estimator, std::int64_t duration_us)
      : estimator_(estimator), duration_us_(duration_us) {}

  void add(const Track& track) {
    if (!track.estimate_title.empty()) {
      Series series = empty(track, track.estimate_title, track.estimate_unit);
      series.kind = Series::Kind::estimate;
      estimates_.push_back(thinned(std::move(series), track, [&](const Told& told) {
        return Sample{.value = *in(track.estimate_unit, told.estimate),
                      .sigma = {},
                      .truth = in(track.estimate_unit, told.truth)};
      }));
    }
    Series series = empty(track, track.title, track.unit);
    series.kind = kind_of(track);
    series.only_if_judged = track.only_if_judged;
    series.to_go = track.to_go;
    if (series.kind == Series::Kind::statistic) {
      for (const double probability : {0.025, 0.975})
        series.between.push_back(
            checks::chi_squared_quantile(track.quantity->degrees_of_freedom, probability));
    }
    values_.push_back(thinned(std::move(series), track, [&](const Told& told) {
      return Sample{.value = told.value / track.unit.factor, .sigma = in(track.unit, told.sigma)};
    }));
  }

  void move_to(std::vector<Series>& all) {
    std::ranges::move(estimates_, std::back_inserter(all));
    std::ranges::move(values_, std::back_inserter(all));
  }

 private:
  [[nodiscard]] Series empty(const Track& track, std::string title, const quantities::Unit& unit) const {
    return {.estimator = std::string(estimator_),
            .about = track.quantity,
            .quantity = std::move(title),
            .unit = std::string(unit.name),
            .unit_si = unit.factor};
  }

  template <class AsSample>
  Series thinned(Series series, const Track& track, AsSample sample) const {
    Thinned points({.duration_us = duration_us_, .end_us = track.answers_end_us}, track.longest_wait_us);
    for (const Told& told : track.told) {
      if (told.t_us <= track.drawn_until_us) points.add(told.t_us, sample(told));
    }
    series.points = std::move(points).points();
    return series;
  }

  std::string_view estimator_;
  std::int64_t duration_us_;
  std::vector<Series> estimates_, values_;
};

}  // namespace

void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give) {
  const estimators::Truth truth = drive::truth_of(run.truth, run.own_truth, scenario.duration_us);
  for (const estimators::Estimator* one : estimators::all()) {
    if (!scenario.runs(one->name)) continue;
    one->tracks(run.seen, truth, [&](const Track& track) { give(one->name, track); });
  }
}

std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run) {
  std::vector<Series> all;
  std::string_view of;
  std::optional<Pictures> pictures;
  give_tracks(scenario, run, [&](std::string_view estimator, const Track& track) {
    if (!pictures || of != estimator) {
      if (pictures) pictures->move_to(all);
      pictures.emplace(of = estimator, scenario.duration_us);
    }
    pictures->add(track);
  });
  if (pictures) pictures->move_to(all);
  add_bars(all, scenario);
  std::erase_if(
      all, [](const Series& one) { return one.points.empty() || (one.only_if_judged && one.bars.empty()); });
  return all;
}

}  // namespace canhil::report
