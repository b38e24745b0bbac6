// Estimates against the truth over the time of a run, in as many points as a picture has.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
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

/// A series that is put together while its track grows: into stretches of equal length, with a gap where
/// nothing came for too long.
class GrowingSeries {
 public:
  /// `estimates`: the estimates beside the truth, rather than the values. `scenario` must outlive it.
  GrowingSeries(std::string_view estimator, const quantities::Track& track, bool estimates,
                const scenario::Scenario& scenario);
  /// Takes what the track says of later times than that of its last value that was taken.
  void take(const quantities::Track& track);
  /// The run is over: if answers are missing at its end that is a gap too.
  void end(const quantities::Track& track);
  [[nodiscard]] const Series& series() const { return series_; }

 private:
  [[nodiscard]] Series::Point point_of(const quantities::Told& told) const;
  [[nodiscard]] bool silent_until(std::int64_t t_us, const quantities::Track& track) const;
  void add_silence(std::int64_t from_us);

  const scenario::Scenario& scenario_;
  const quantities::Unit unit_;
  Series series_;
  std::int64_t last_us_ = std::numeric_limits<std::int64_t>::min();  // of the last value
};

/// Takes a track of the estimator of this name.
using TrackOf = std::function<void(std::string_view estimator, const quantities::Track& track)>;
/// Gives the tracks of every estimator that the scenario runs, estimator by estimator.
void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give);

/// Of every estimator that the scenario runs.
std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
