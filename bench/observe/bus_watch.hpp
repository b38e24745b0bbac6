// Records error frames and outages of the bus in a run. Silence during an outage is excused.
#pragma once

#include <optional>
#include <string_view>

#include "bench/checks/bus.hpp"
#include "bench/observe/observer.hpp"

namespace canhil::observe {

class BusWatch final : public Observer {
 public:
  /// `port`: the port whose clock measures deadlines.
  explicit BusWatch(const Port& port) : port_(port) {}
  void received(const Received& received) override;
  void interface_changed(bool up, std::int64_t t_ns) override;

  /// The current outage: its cause, and its start on the clock of Port::monotonic_ns().
  struct Outage {
    std::string_view what;
    std::int64_t since_ns = 0;
  };
  [[nodiscard]] const std::optional<Outage>& outage() const { return outage_; }
  /// The time at which the last outage ended, on the clock of Port::monotonic_ns(). 0: there was no outage.
  [[nodiscard]] std::int64_t ended_ns() const { return ended_ns_; }

  [[nodiscard]] const checks::BusRecord& record() const { return record_; }

 private:
  void note(std::int64_t t_ns, BusEvent event);
  void begin(std::string_view what);
  void end();

  const Port& port_;
  checks::BusRecord record_;
  std::optional<Outage> outage_;
  std::int64_t ended_ns_ = 0;
};

}  // namespace canhil::observe
