#include "bench/checks/judge.hpp"
#include "bench/drive/dialect.hpp"
#include "bench/drive/handshake.hpp"
#include "bench/estimators/of_scenario.hpp"
#include "bench/protocol/contract_watch.hpp"
#include "bench/protocol/monitor.hpp"
#include "bench/scenario/binding.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t four_heartbeats_ns = 400'000'000;  // a dead target is reported within 0.5 s

class ContractDialect final : public Dialect {
 public:
  explicit ContractDialect(const Setting& setting) : of_(setting) {}

  std::unique_ptr<Schedule> schedule(std::unique_ptr<faults::Faults> faults) override {
    return std::unique_ptr<Schedule>(
        new Schedule(make_schedule(of_.scenario, of_.truth, of_.flight.per_run_truth, of_.run_index,
                                   of_.virtual_time, of_.rounding, std::move(faults))));
  }
  [[nodiscard]] bool watches_frames_alone() const override { return true; }
  std::unique_ptr<observe::Watcher> watcher(bool with_times) override {
    if (!with_times) return std::make_unique<protocol::Monitor>();
    WireFacts wire = of_.wire;
    wire.fd = of_.format == BusFormat::fd;
    return std::make_unique<protocol::Monitor>(
        protocol::Asked{.windows = checks::timed_windows(of_.scenario.checks),
                        .wire = wire,
                        .takers = estimators::takers(of_.scenario),
                        .own_interval_s = estimators::own_intervals_s(of_.scenario)});
  }
  std::unique_ptr<observe::TargetWatch> target_watch(bool alone) override {
    return std::make_unique<protocol::ContractWatch>(alone);
  }
  Result<void> configure(Link& link, nodes::Transmission& out,
                         const std::function<std::optional<std::string>()>& gone) override {
    return drive::configure(link, out, of_.scenario.targets, of_.flight.initial, gone, of_.format);
  }
  void stop(Link& link, nodes::Transmission& out) override { drive::stop(link, out, of_.scenario.targets); }
  [[nodiscard]] std::int64_t silence_limit_ns() const override { return four_heartbeats_ns; }

 private:
  Setting of_;
};

}  // namespace

std::unique_ptr<Dialect> contract_dialect(const Setting& setting) {
  return std::make_unique<ContractDialect>(setting);
}

Result<std::unique_ptr<Dialect>> make_dialect(const Setting& setting) {
  if (setting.scenario.binding->handshake) return contract_dialect(setting);
  return mapped_dialect(setting);
}

}  // namespace canhil::drive
