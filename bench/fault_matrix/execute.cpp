#include "bench/fault_matrix/execute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "bench/drive/contract.hpp"
#include "bench/drive/session.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/fault_matrix/minimise.hpp"
#include "bench/fault_matrix/response.hpp"
#include "bench/report/file.hpp"

namespace canhil::fault_matrix {
namespace {

namespace fs = std::filesystem;

struct Flown {
  scenario::Scenario scenario;
  drive::Run run;
};

// The flights of one matrix.
class Flights {
 public:
  Flights(const Plan& plan, const Options& options, const std::atomic<bool>& stop)
      : plan_(plan), options_(options), stop_(stop) {}

  Result<void> fly(const std::set<std::size_t>& cells) {
    std::vector<std::size_t> order(cells.begin(), cells.end());
    std::vector<std::pair<std::size_t, std::uint64_t>> needed;  // (column, run) pairs to fly without faults
    for (const std::size_t cell : order) needed.emplace_back(plan_.cells[cell].column, plan_.cells[cell].run);
    std::ranges::sort(needed);
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    std::vector<Undisturbed> found(needed.size());
    auto flown = each(needed.size(), [&](std::size_t index) -> Result<void> {
      auto one = fly(plan_.columns[needed[index].first], needed[index].second, {}, 0);
      if (!one) return tl::unexpected(one.error());
      found[index] = undisturbed(one->scenario, one->run);
      return {};
    });
    if (!flown || stop_) return flown;
    for (std::size_t index = 0; index < needed.size(); ++index)
      undisturbed_.emplace(needed[index], std::move(found[index]));
    return each(order.size(), [&](std::size_t index) { return fly_cell(order[index]); });
  }

 private:
  // Calls fly_one for each index, on all cores. Returns the first error that occurred.
  Result<void> each(std::size_t count, const std::function<Result<void>(std::size_t)>& fly_one) {
    std::atomic<std::size_t> next = 0;
    std::optional<Error> error;
    const std::size_t cores = options_.threads > 0 ? options_.threads : std::thread::hardware_concurrency();
    {
      std::vector<std::jthread> workers;
      for (std::size_t i = 0; i < std::clamp<std::size_t>(cores, 1, std::max<std::size_t>(count, 1)); ++i) {
        workers.emplace_back([&] {
          for (std::size_t index = next++; index < count && !stop_; index = next++) {
            const auto flown = fly_one(index);
            if (flown || stop_) continue;
            const std::scoped_lock lock(mutex_);
            if (!error) error = flown.error();
            next = count;
          }
        });
      }
    }
    if (error) return tl::unexpected(*error);
    return {};
  }

  [[nodiscard]] Result<Flown> fly(scenario::Scenario scenario, const std::string& log) const {
    drive::Options options;
    if (options_.target.empty())
      options.bus = drive::BusName(std::string(drive::in_process_bus));
    else
      options = drive::in_lockstep_against(options_.target);
    options.format = drive::format_of(scenario);
    if (!log.empty()) options.log_path = log;
    auto run = drive::run(scenario, options, stop_, [](std::int64_t) {});
    if (!run) return tl::unexpected(run.error());
    if (run->log_error) return tl::unexpected(*run->log_error);
    return Flown{.scenario = std::move(scenario), .run = std::move(*run)};
  }
  [[nodiscard]] Result<Flown> fly(const Column& column, std::uint64_t run,
                                  const std::vector<FaultText>& faults, std::int64_t duration_us) const {
    auto scenario = scenario_of(column, run, faults, duration_us);
    if (!scenario) return tl::unexpected(scenario.error());
    return fly(std::move(*scenario), "");
  }

  Result<void> fly_cell(std::size_t index) {
    const Cell& cell = plan_.cells[index];
    const Undisturbed& before = undisturbed_.at({cell.column, cell.run});
    auto flown = fly(plan_.columns[cell.column], cell.run, cell.faults, 0);
    if (!flown) return tl::unexpected(flown.error());
    if (flown->run.ending.kind == drive::Ending::Kind::interrupted) return {};
    Finished finished{.cell = index, .row = cell.row, .column = cell.column, .run = cell.run};
    finished.response = response_of(flown->scenario, flown->run, cell.faults.empty() ? nullptr : &before);
    for (const FaultText& fault : cell.faults) finished.faults.push_back(fault.in_line());
    if (finished.response.kind == Response::Kind::violated) {
      if (auto kept = keep(cell, before, flown->run, finished); !kept) return kept;
    }
    if (stop_) return {};
    const std::scoped_lock lock(mutex_);
    return options_.finished(std::move(finished));
  }

  // Saves the minimal scenario that shows the same violation, and the log of its flight.
  Result<void> keep(const Cell& cell, const Undisturbed& before, const drive::Run& run,
                    Finished& finished) const {
    const Column& column = plan_.columns[cell.column];
    const std::string& check = finished.response.check;
    const bool by_a_check = check != flight_itself;
    const auto shows = [&](const std::vector<FaultText>& faults, std::int64_t duration_us) {
      const auto flown = fly(column, cell.run, faults, duration_us);
      if (!flown || stop_) return false;
      // In a run that ends early, a check is not judged, so the check is not violated.
      if (by_a_check && flown->run.ending.kind != drive::Ending::Kind::completed) return false;
      const Response response =
          response_of(flown->scenario, flown->run, cell.faults.empty() ? nullptr : &before);
      return response.kind == Response::Kind::violated && response.check == check;
    };
    const Minimised least = minimise(cell.faults, run.ending.t_us, shows);
    const auto [file, log] = files_of_violation(options_.folder, finished.cell);
    // A scenario needs at least one check. If the violated check is in judged_by, the saved scenario contains
    // this check. Any other violation ends the run or belongs to an implied check, which is made in every
    // run; the saved scenario then contains the check `answering`.
    const std::string text =
        text_of(column, cell.run, least.faults, least.duration_us,
                std::ranges::find(judged_by, check) == judged_by.end() ? "answering" : check,
                fmt::format("# The minimal form of '{}' that violates {}: hil-bench faults --seed {}.\n",
                            plan_.rows[cell.row].name(), check, plan_.seed));
    if (auto written = report::write_file(file.string(), text); !written) return written;
    auto scenario = drive::read_scenario(file.string());
    if (!scenario) return tl::unexpected(scenario.error());
    if (auto flown = fly(std::move(*scenario), log.string()); !flown) return tl::unexpected(flown.error());
    finished.replay = file.filename().string();
    for (const FaultText& fault : least.faults) finished.least.push_back(fault.in_line());
    return {};
  }

  const Plan& plan_;
  const Options& options_;
  const std::atomic<bool>& stop_;
  std::map<std::pair<std::size_t, std::uint64_t>, Undisturbed> undisturbed_;
  std::mutex mutex_;
};

}  // namespace

std::array<fs::path, 2> files_of_violation(const fs::path& folder, std::size_t cell) {
  const std::string name = fmt::format("violation-{}", cell);
  return {folder / (name + ".toml"), folder / (name + ".log")};
}

std::string replay_command(const std::string& file, const std::string& target) {
  if (target.empty()) return fmt::format("hil-bench run {} --bus in-process", file);
  return fmt::format("hil-bench run {} --lockstep --target '{}'", file, target);
}

Result<void> execute(const Plan& plan, const std::set<std::size_t>& cells, const Options& options,
                     const std::atomic<bool>& stop) {
  return Flights(plan, options, stop).fly(cells);
}

}  // namespace canhil::fault_matrix
