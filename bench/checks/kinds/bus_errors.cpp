#include "bench/checks/kinds/bus_errors.hpp"

#include <array>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

BusErrorLimits BusErrorLimits::read(scenario::Section& section, const scenario::CheckContext& /*context*/) {
  return {
      .bus_off_at_most =
          section.optional_integer({"bus_off_at_most", "Maximum number of bus-offs; 0 if not given."}, 0)
              .value_or(0),
      .down_at_most =
          section
              .optional_integer(
                  {"down_at_most", "Maximum number of outages of the interface; 0 if not given."}, 0)
              .value_or(0),
      .passive_at_most = section.optional_integer(
          {"passive_at_most", "Maximum number of times that the controller becomes error passive."}, 0),
      .warning_at_most = section.optional_integer(
          {"warning_at_most", "Maximum number of times that the controller reports an error warning."}, 0),
      .error_frames_at_most =
          section.optional_integer({"error_frames_at_most", "Maximum number of error frames."}, 0),
      .late_in_queue_at_most =
          section.optional_integer({"late_in_queue_at_most",
                                    "Maximum number of frames that wait in the transmit queue for longer "
                                    "than 10 ms, the cycle time of Sync."},
                                   0)};
}

Finding BusErrorLimits::judge(const Evidence& evidence) const {
  const BusRecord& bus = evidence.seen.bus;
  const auto& errors = bus.errors;
  Finding finding = within_limits(
      std::array<CountLimit, 6>{{{"bus off", bus_off_at_most, errors.bus_off},
                                 {"interface down", down_at_most, bus.downs},
                                 {"error passive", passive_at_most, errors.passive},
                                 {"error warning", warning_at_most, errors.warning},
                                 {"error frames", error_frames_at_most, errors.frames},
                                 {"late in transmit queue", late_in_queue_at_most, bus.late_in_queue}}});
  if (finding.outcome != Outcome::pass || bus.reports_errors || errors.frames > 0) return finding;
  return {Outcome::not_measured, "this bus reports no errors: it has no controller and no wire",
          std::move(finding.expected)};
}

}  // namespace canhil::checks
