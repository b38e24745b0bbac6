// Estimates and truth over the time of a run, with as many points as a picture needs.
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
           high = 0;  ///< range of the quantity until the next point; not finite: no answers until then
    std::optional<double> sigma{};  ///< the largest reported sigma; none: not reported in time
    std::optional<double> truth{};  ///< for an estimate: the true value at t_s
  };
  /// The limit that a check sets for the absolute value.
  struct Bar {
    std::string check;           ///< name of the check
    std::string_view statistic;  ///< statistic of the values in the check's window: max, mean, rms
    double below = 0;            ///< in the unit of the series
    double from_s = 0, to_s = 0;
  };
  std::string estimator;  ///< "plant": an output of the plant
  std::string name;       ///< of the quantity
  std::string quantity;   ///< for people
  std::string unit;
  Kind kind = Kind::error;
  std::vector<Point> points{};
  std::vector<double> between{};  ///< for a statistic: the 95 % interval of a consistent filter
  std::vector<Bar> bars{};
};

/// A series that grows with its track. Each point represents a stretch of time; all stretches have equal
/// length. The series has a gap where no answer came for too long.
class GrowingSeries {
 public:
  /// `estimates`: show estimates and truth instead of the values. `scenario` must outlive this object.
  GrowingSeries(std::string_view estimator, const quantities::Track& track, bool estimates,
                const scenario::Scenario& scenario);
  /// Adds the values of a track that are later than the last added value, up to a time of validity [us].
  void take(const quantities::Track& track, std::int64_t until_us = std::numeric_limits<std::int64_t>::max());
  /// Ends the series after the run: if answers are missing at the end, adds a gap.
  void end(const quantities::Track& track);
  [[nodiscard]] const Series& series() const { return series_; }

 private:
  [[nodiscard]] Series::Point point_of(const quantities::TrackPoint& answer) const;
  [[nodiscard]] bool silent_until(std::int64_t t_us, const quantities::Track& track) const;
  void add_silence(std::int64_t from_us);

  const scenario::Scenario& scenario_;
  const quantities::Unit unit_;
  Series series_;
  std::int64_t last_us_ = std::numeric_limits<std::int64_t>::min();  // time of the last value
};

/// Receives a track and the name of its estimator.
using TrackOf = std::function<void(std::string_view estimator, const quantities::Track& track)>;
/// Passes on the tracks of the scenario's estimators, one estimator after another.
void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give);

/// A plant of a run: its outputs over the run, as PlantFacts::outputs.
struct OwnPlant {
  const scenario::PlantFacts& facts;
  const world::PlantRecord& record;
};
/// The plants of a run; none if the run was cut off.
std::vector<OwnPlant> plants_of(const scenario::Scenario& scenario, const drive::Run& run);

/// The series of all estimators of the scenario, and of the outputs of [plant].
std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
