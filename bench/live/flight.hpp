// A flight as the view shows it: computed from the frames so far and, after the end, from the finished run.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/drive/onlooker.hpp"
#include "bench/drive/session.hpp"
#include "bench/live/snapshot.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::live {

/// What is known about a flight before it begins.
Flight flight_of(const scenario::Scenario& scenario, const drive::Options& options);

/// The finished flight, with the numbers of its report.
Flight flight_of(const scenario::Scenario& scenario, const drive::Run& run);

/// Observes the frames of a flight in progress. Uses the same watchers, tracks and checks that judge the
/// flight at its end. Neither the memory nor the work for one update grows with the length of the flight.
class FlightInProgress final : public observe::Observer {
 public:
  /// The objects that the departure refers to must outlive this object.
  explicit FlightInProgress(const drive::Departure& departure);

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  void foreign(const Received& received) override;
  void time_set(std::int64_t t_ns) override;
  void interface_changed(bool up, std::int64_t t_ns) override;

  [[nodiscard]] bool real_time() const { return departure_.real_time; }
  /// The records that receive the rows of drive::growing_plants_of().
  [[nodiscard]] std::span<world::PlantRecord> plants() { return plants_; }

  /// Updates `flight` to the current time. `all_seen`: the view missed no frame, so checks may be judged. A
  /// series ends 1.5 s before now, because the sigma of a late fix arrives late. `landed`: the run is over,
  /// so a series ends now.
  void update(Flight& flight, bool all_seen, bool landed = false);

 private:
  struct Known {  // a series, and whether the page shows it
    std::string_view estimator;
    const quantities::Quantity* quantity = nullptr;
    bool estimates = false, shown = false;
    report::GrowingSeries series;
  };

  void each_watcher(const std::function<void(observe::Observer&)>& show);
  void move_window();
  void take_tracks(Flight& flight, std::int64_t until_us);
  void take(std::string_view estimator, const quantities::Track& track, bool estimates,
            std::int64_t until_us);
  void judge_ended(Flight& flight);
  [[nodiscard]] std::int64_t now_us() const;
  [[nodiscard]] estimators::Truth truth() const;

  drive::Departure departure_;
  std::vector<world::PlantRecord> plants_{};  // copies of the records that the flight extends
  observe::LoadMeter load_;
  std::unique_ptr<observe::Watcher> whole_;  // for the whole flight: times and checks
  // Two watchers for tracks. The older watcher has received all frames since it started: at the beginning of
  // the flight, or between one and two window_us ago. After each window_us, the newer watcher replaces the
  // older one, and another watcher starts.
  std::unique_ptr<observe::Watcher> recent_, next_recent_;
  std::int64_t window_since_us_ = 0;
  std::vector<Known> known_{};
  std::vector<std::int64_t> judged_at_us_;  // for each check of the scenario; negative: not judged yet
  std::optional<std::int64_t> first_ns_{};
  std::int64_t last_ns_ = 0;
  std::optional<std::int64_t> virtual_ns_{};
};

}  // namespace canhil::live
