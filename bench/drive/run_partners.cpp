#include "bench/drive/run_partners.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/drive/session.hpp"
#include "bench/partners/partner.hpp"

namespace canhil::drive {

RunPartners::RunPartners(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                         PerRunTruth& own, Schedule& schedule)
    : scenario_(scenario),
      truth_(truth),
      own_(own),
      schedule_(schedule),
      interventions_(
          [&schedule](std::string_view name, bool begins, std::int64_t t_us) {
            return schedule.faults()->command(name, begins, t_us);
          },
          *own.overrides, scenario, own.stopper()) {}

Result<void> RunPartners::join(const Options& options, bool virtual_time) {
  const partners::Stage stage{.scenario = scenario_,
                              .run_index = options.run_index,
                              .truths = truths_of(truth_, own_),
                              .end_us = truth_.end_us(),
                              .virtual_time = virtual_time,
                              .fd = options.format != BusFormat::classic,
                              .interventions = interventions_};
  for (const scenario::NodeProgram& one : scenario_.programs) {
    auto partner = partners::Partner::start(one.name, one.program, stage);
    if (!partner) return failure(fmt::format("{}: {}", scenario_.file, partner.error().message));
    schedule_.add(*std::move(partner));
  }
  if (options.control.empty()) return {};
  auto socket = partners::ControlSocket::listen(options.control);
  if (!socket) return tl::unexpected(socket.error());
  control_ = *std::move(socket);
  auto client = partners::Partner::client(*control_, stage, options.awaits_control);
  if (!client) return tl::unexpected(client.error());
  schedule_.add(*std::move(client));
  return {};
}

void RunPartners::prepare(const scenario::Scenario& scenario, const Options& options, PerRunTruth& own) {
  if (!scenario.programs.empty() || !options.control.empty())
    own.overrides = std::make_shared<sensors::Overrides>();
}

// The estimator may refuse samples with values that a partner put into them.
void RunPartners::add_to(checks::Observations& seen) const {
  for (std::string& note : interventions_.notes()) seen.bus.notes.push_back(std::move(note));
  seen.expected_counts.most.bad_group += own_.overrides->samples * scenario_.targets.size();
}

}  // namespace canhil::drive
