// The programs of the user that take part in a run.
#pragma once

#include <memory>

#include "bench/checks/observations.hpp"
#include "bench/drive/flight.hpp"
#include "bench/partners/control_socket.hpp"
#include "bench/partners/interventions.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

struct Options;

class RunPartners {
 public:
  /// Prepares the truth of a run for partners, if it has some.
  static void prepare(const scenario::Scenario& scenario, const Options& options, PerRunTruth& own);
  /// All arguments must outlive this object. The truth of the run must be prepared.
  RunPartners(const scenario::Scenario& scenario, const world::FlightRecord& truth, PerRunTruth& own,
              Schedule& schedule);

  /// Starts the programs of [[node]], opens the control socket, and adds them to the schedule. Error, one
  /// line: a program cannot be started, or no client came.
  Result<void> join(const Options& options, bool virtual_time);
  /// Adds what the partners did in the run, one line each, and what the target may do because of it.
  void add_to(checks::Observations& seen) const;

 private:
  const scenario::Scenario& scenario_;
  const world::FlightRecord& truth_;
  PerRunTruth& own_;
  Schedule& schedule_;
  partners::Interventions interventions_;
  std::unique_ptr<partners::ControlSocket> control_;
};

}  // namespace canhil::drive
