// The interface of an onlooker: an object that observes a flight during the flight. A thread of the onlooker
// may read the flight's truth.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "bench/drive/flight.hpp"
#include "bench/observe/load_meter.hpp"
#include "bench/observe/watcher.hpp"
#include "dbc/ports/fd_groups.hpp"

namespace canhil::drive {

/// The facts about a flight when the flight begins. The objects to which a Departure refers stay valid until
/// Onlooker::landed().
struct Departure {
  const scenario::Scenario& scenario;
  const world::FlightRecord& truth;
  const PerRunTruth& per_run_truth;  ///< its plants advance during the flight, in the flight's thread
  bool real_time = false;
  BusFormat format = BusFormat::classic;
  WireFacts wire{};
  observe::LoadBy load_by = observe::LoadBy::stamps;
  /// Makes another watcher of the flight's frames, with or without times. An empty function: there can be no
  /// other watcher, because the flight's own watcher depends not only on frames but also on data that the
  /// flight's thread changes.
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
