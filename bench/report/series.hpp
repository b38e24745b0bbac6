// Estimates against the truth over the time of a run, in as many points as a picture has.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/drive/session.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::report {

struct Series {
  static constexpr std::size_t max_points = 300;
  enum class Kind : std::uint8_t { estimate, error, innovation, statistic };
  struct Point {
    double t_s = 0;
    double low = 0,
           high = 0;  ///< the quantity covers this until the next point; not finite: silence until then
    std::optional<double> sigma{};  ///< the largest that the target told; none: it told none in time
    std::optional<double> truth{};  ///< of an estimate: the true value at t_s
  };
  /// What a check asks of the absolute value.
  struct Bar {
    std::string check;           ///< its name
    std::string_view statistic;  ///< of the values in its window: max, mean, rms
    double below = 0;            ///< in the series' unit
    double from_s = 0, to_s = 0;
  };
  std::string estimator;
  const quantities::Quantity* about = nullptr;
  std::string quantity;  ///< in words
  std::string unit;
  Kind kind = Kind::error;
  std::vector<Point> points{};
  std::vector<double> between{};  ///< of a statistic: 95 % of the values of a consistent filter lie here
  std::vector<Bar> bars{};
};

/// Takes a track of the estimator of this name.
using TrackOf = std::function<void(std::string_view estimator, const quantities::Track& track)>;
/// Gives the tracks of every estimator that the scenario runs, estimator by estimator.
void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give);

/// Of every estimator that the scenario runs.
std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
