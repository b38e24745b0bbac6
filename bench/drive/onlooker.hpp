// Who looks on at a flight, and from where: its own thread may look at the same truth while the flight goes
// on.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "bench/drive/flight.hpp"
#include "bench/observe/load_meter.hpp"
#include "bench/observe/watcher.hpp"
#include "dbc/ports/fd_groups.hpp"

namespace canhil::drive {

/// What is known of a flight when it begins. All that it refers to holds until Onlooker::landed().
struct Departure {
  const scenario::Scenario& scenario;
  const world::FlightRecord& truth;
  const PerRunTruth& per_run_truth;  ///< its engagement grows, in the thread of the flight
  bool real_time = false;
  BusFormat format = BusFormat::classic;
  WireFacts wire{};
  observe::LoadBy load_by = observe::LoadBy::stamps;
  /// Another watcher of the flight's frames, without times or with them. None: what the flight's own watcher
  /// looks at beside the frames changes in the thread of the flight.
  std::function<std::unique_ptr<observe::Watcher>(bool with_times)> watcher{};
};

class Onlooker : public observe::Observer {
 public:
  /// Called before the first frame.
  virtual void departs(const Departure& /*departure*/) {}
  /// Called after the last frame.
  virtual void landed() {}
};

}  // namespace canhil::drive
