#include "bench/campaign/matrix/flights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/campaign/matrix/minimise.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/session.hpp"
#include "dbc/files/output_file.hpp"

namespace canhil::campaign::matrix {

namespace fs = std::filesystem;

std::array<fs::path, 2> files_of_violation(const fs::path& folder, std::size_t flight) {
  const std::string name = fmt::format("violation-{}", flight);
  return {folder / (name + ".toml"), folder / (name + ".log")};
}

std::string replay_command(const std::string& file, const std::string& target) {
  if (target.empty()) return fmt::format("hil-bench run {} --bus in-process", file);
  return fmt::format("hil-bench run {} --lockstep --target '{}'", file, target);
}

Result<std::optional<Flown>> Flights::fly(const Cell& cell, std::uint64_t run, std::size_t flight) {
  std::optional<Flown> flown;
  const Result<Undisturbed>& before = undisturbed_of(cell.column, run, cell.row == 0 ? &flown : nullptr);
  if (stop_) return std::nullopt;
  if (!before) return tl::unexpected(before.error());
  const std::vector<FaultText> faults = matrix_.faults_of(cell, run);
  if (!flown) {
    auto one = fly(matrix_.columns[cell.column], run, faults, 0);
    if (stop_) return std::nullopt;
    if (!one) return tl::unexpected(one.error());
    flown = std::move(*one);
  }
  if (flown->run.ending.kind == drive::Ending::Kind::interrupted) return std::nullopt;
  const Undisturbed* other = cell.row == 0 ? nullptr : &*before;
  flown->result.response = response_of(flown->scenario, flown->run, other);
  for (const FaultText& fault : faults) flown->result.faults.push_back(fault.in_line());
  if (flown->result.response.kind == Response::Kind::violated) {
    if (auto kept = keep(cell, run, flight, faults, other, *flown); !kept)
      return tl::unexpected(kept.error());
  }
  if (stop_) return std::nullopt;
  return flown;
}

Flights::Before& Flights::before_of(std::size_t column, std::uint64_t run) {
  const std::scoped_lock lock(mutex_);
  auto& before = before_[{column, run}];
  if (before == nullptr) before = std::make_unique<Before>();
  return *before;
}

const Result<Undisturbed>& Flights::undisturbed_of(std::size_t column, std::uint64_t run,
                                                   std::optional<Flown>* flown) {
  Before& before = before_of(column, run);
  std::call_once(before.flown, [&] {
    auto one = fly(matrix_.columns[column], run, {}, 0);
    if (!one) {
      before.found = tl::unexpected(one.error());
      return;
    }
    before.found = undisturbed(one->scenario, one->run);
    if (flown != nullptr) *flown = std::move(*one);
  });
  return before.found;
}

Result<Flown> Flights::fly(scenario::Scenario scenario, const std::string& log) const {
  drive::Options options = drive::unattended(target_, scenario);
  if (!log.empty()) options.log_path = log;
  auto run = drive::run(scenario, options, stop_, [](std::int64_t) {});
  if (!run) return tl::unexpected(run.error());
  if (run->log_error) return tl::unexpected(*run->log_error);
  return Flown{.scenario = std::move(scenario), .run = std::move(*run)};
}

Result<Flown> Flights::fly(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                           std::int64_t duration_us) const {
  auto scenario = scenario_of(column, run, faults, duration_us);
  if (!scenario) return tl::unexpected(scenario.error());
  return fly(std::move(*scenario), "");
}

// Saves the minimal scenario that shows the same violation, and the log of its flight.
Result<void> Flights::keep(const Cell& cell, std::uint64_t run, std::size_t flight,
                           const std::vector<FaultText>& faults, const Undisturbed* before,
                           Flown& flown) const {
  const Column& column = matrix_.columns[cell.column];
  CellRun& result = flown.result;
  const std::string& check = result.response.check;
  const bool by_a_check = check != flight_itself;
  const auto shows = [&](const std::vector<FaultText>& some, std::int64_t duration_us) {
    const auto again = fly(column, run, some, duration_us);
    if (!again || stop_) return false;
    // In a run that ends early, a check is not judged, so the check is not violated.
    if (by_a_check && again->run.ending.kind != drive::Ending::Kind::completed) return false;
    const Response response = response_of(again->scenario, again->run, before);
    return response.kind == Response::Kind::violated && response.check == check;
  };
  const Minimised least = minimise(faults, flown.run.ending.t_us, shows);
  const auto [file, log] = files_of_violation(folder_, flight);
  const std::string text = text_of(column, run, least.faults, least.duration_us, check,
                                   fmt::format("# The minimal form of '{}' in {} that violates {}.\n",
                                               matrix_.rows[cell.row].name(), column.file, check));
  if (auto written = write_file(file.string(), text); !written) return written;
  auto scenario = drive::read_scenario(file.string());
  if (!scenario) return tl::unexpected(scenario.error());
  if (auto last = fly(std::move(*scenario), log.string()); !last) return tl::unexpected(last.error());
  result.replay = file.filename().string();
  result.target = target_;
  for (const FaultText& fault : least.faults) result.least.push_back(fault.in_line());
  return {};
}

}  // namespace canhil::campaign::matrix
