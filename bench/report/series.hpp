// Estimates and truth over the time of a run, with as many points as a picture needs.
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
           high = 0;  ///< range of the quantity until the next point; not finite: silence until then
    std::optional<double> sigma{};  ///< the largest reported sigma; none: not reported in time
    std::optional<double> truth{};  ///< for an estimate: the true value at t_s
  };
  /// The limit that a check sets for the absolute value.
  struct Bar {
    std::string check;           ///< its name
    std::string_view statistic;  ///< of the values in its window: max, mean, rms
    double below = 0;            ///< in the series' unit
    double from_s = 0, to_s = 0;
  };
  std::string estimator;
  const quantities::Quantity* about = nullptr;
  std::string quantity;  ///< for people
  std::string unit;
  Kind kind = Kind::error;
  std::vector<Point> points{};
  std::vector<double> between{};  ///< for a statistic: the 95 % interval of a consistent filter
  std::vector<Bar> bars{};
};

/// Receives a track of the estimator of this name.
using TrackOf = std::function<void(std::string_view estimator, const quantities::Track& track)>;
/// Passes on the tracks of the scenario's estimators, one estimator after another.
void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give);

/// For all estimators of the scenario.
std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
