#include "bench/faults/kinds/controller.hpp"

#include <fmt/format.h>

#include "bench/scenario/section.hpp"
#include "dbc/ports/bus_errors.hpp"

namespace canhil::faults {
namespace {

constexpr int passive_from = 128;  // error count, from ISO 11898-1, fault confinement

// Only vcan accepts error frames from programs; the driver of a controller generates its own error frames.
std::string needs_vcan(const Place& place) {
  switch (place.interface) {
    case Place::Interface::virtual_can:
      return {};
    case Place::Interface::controller:
      return fmt::format(
          "can only be reported by a controller's driver, which '{}' has, expected a vcan interface",
          place.bus);
    case Place::Interface::none:
      break;
  }
  return fmt::format("needs error frames, which '{}' does not carry, expected a vcan interface", place.bus);
}

class ReportedErrors final : public Repeated {
 public:
  ReportedErrors(const ErrorFrames& kind, const InRun& run)
      : Repeated(kind.when, kind.period_us, run), rig_(run.hands) {}

 private:
  void strike(std::vector<Frame>& /*out*/) override {
    rig_->report_error(error_frame({.seen = SeenError::stuff}));
  }
  RigControl* rig_;
};

// Reports a state of the controller and, at the end of the fault, the state to which the controller returns.
class ReportedState final : public Switched {
 public:
  ReportedState(const When& when, const InRun& run, const ControllerNews& begin, const ControllerNews& end)
      : Switched(when, run), begin_(error_frame(begin)), end_(error_frame(end)) {}

 private:
  void on(std::int64_t /*for_us*/) override { rig_->report_error(begin_); }
  void off() override { rig_->report_error(end_); }
  Frame begin_, end_;
};

class Downs final : public Switched {
 public:
  using Switched::Switched;

 private:
  void on(std::int64_t for_us) override { rig_->interface_down(for_us); }
  void off() override { rig_->interface_up(); }
};

}  // namespace

ErrorFrames ErrorFrames::read(scenario::Section& section, const scenario::FaultContext& context) {
  return {.when = read_when(section, context, Repeats::stretch),
          .period_us = section.time_us({"period_ms", "Time from one reported error to the next."},
                                       scenario::Limits::above(0))};
}
std::string ErrorFrames::cannot(const Place& place) const { return needs_vcan(place); }
std::unique_ptr<Injector> ErrorFrames::injector(const InRun& run) const {
  return std::make_unique<ReportedErrors>(*this, run);
}

ErrorPassive ErrorPassive::read(scenario::Section& section, const scenario::FaultContext& context) {
  return {.when = read_stretches(section, context)};
}
std::string ErrorPassive::cannot(const Place& place) const { return needs_vcan(place); }
std::unique_ptr<Injector> ErrorPassive::injector(const InRun& run) const {
  return std::make_unique<ReportedState>(
      when, run, ControllerNews{.event = BusEvent::error_passive, .tx_counter = passive_from},
      ControllerNews{.event = BusEvent::error_active});
}

BusOff BusOff::read(scenario::Section& section, const scenario::FaultContext& context) {
  return {.when = read_stretches(section, context)};
}
std::string BusOff::cannot(const Place& place) const { return needs_vcan(place); }
std::unique_ptr<Injector> BusOff::injector(const InRun& run) const {
  return std::make_unique<ReportedState>(when, run, ControllerNews{.event = BusEvent::bus_off},
                                         ControllerNews{.event = BusEvent::restarted});
}

InterfaceDown InterfaceDown::read(scenario::Section& section, const scenario::FaultContext& context) {
  return {.when = read_stretches(section, context)};
}
std::string InterfaceDown::cannot(const Place& place) const {
  if (place.interface == Place::Interface::none)
    return fmt::format("needs an interface, which '{}' is not, expected one of the kernel", place.bus);
  if (place.virtual_time) return "has no effect in virtual time, which waits for the bus, expected real time";
  if (!place.may_set_interface)
    return fmt::format("may not set '{}' up and down, expected the capability CAP_NET_ADMIN", place.bus);
  return {};
}
std::unique_ptr<Injector> InterfaceDown::injector(const InRun& run) const {
  return std::make_unique<Downs>(when, run);
}

}  // namespace canhil::faults
