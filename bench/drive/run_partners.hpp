// The programs of the user that take part in a run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/drive/flight.hpp"
#include "bench/partners/control_socket.hpp"
#include "bench/partners/interventions.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

struct Options;

class RunPartners {
 public:
  /// All arguments must outlive this object. The truth of the run must have overrides.
  RunPartners(const scenario::Scenario& scenario, const world::FlightRecord& truth, PerRunTruth& own,
              Schedule& schedule);

  /// Starts the programs of [[node]], opens the control socket, and adds them to the schedule. Error, one
  /// line: a program cannot be started, or no client came.
  Result<void> join(const Options& options, bool virtual_time, bool fd);
  /// What the partners did in the run, one line each.
  void add_notes(std::vector<std::string>& notes) const;

 private:
  const scenario::Scenario& scenario_;
  const world::FlightRecord& truth_;
  PerRunTruth& own_;
  Schedule& schedule_;
  partners::Interventions interventions_;
  std::unique_ptr<partners::ControlSocket> control_;
};

}  // namespace canhil::drive
