// Flies the cells of a matrix of faults. The results depend on the matrix alone, not on threads, shards or
// interruptions.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bench/campaign/matrix/matrix.hpp"
#include "bench/campaign/matrix/response.hpp"

namespace canhil::campaign::matrix {

/// The files in which a violation is saved: the minimal scenario, and the log of its flight. `flight`: the
/// number of the violating flight in the campaign.
std::array<std::filesystem::path, 2> files_of_violation(const std::filesystem::path& folder,
                                                        std::size_t flight);

/// The command that repeats a saved violation, for example "hil-bench run FILE --bus in-process".
std::string replay_command(const std::string& file, const std::string& target);

struct Flown {
  scenario::Scenario scenario;
  drive::Run run;
  CellRun result{};
};

class Flights {
 public:
  /// `target`: a target program, run in lockstep; empty: a Device in this process. `folder`: the folder in
  /// which the scenarios of violations are saved.
  Flights(const Matrix& matrix, std::string target, std::filesystem::path folder,
          const std::atomic<bool>& stop)
      : matrix_(matrix), target_(std::move(target)), folder_(std::move(folder)), stop_(stop) {}

  /// Flies a run of a cell, and the run of its scenario without faults if that was not flown yet. `flight`:
  /// its number in the campaign. May be called from several threads. None: it was interrupted. Error, one
  /// line: the flight could not be flown.
  Result<std::optional<Flown>> fly(const Cell& cell, std::uint64_t run, std::size_t flight);

 private:
  // The flight of a column and run without faults, flown once.
  struct Before {
    std::once_flag flown{};
    Result<Undisturbed> found{};
  };
  Before& before_of(std::size_t column, std::uint64_t run);
  const Result<Undisturbed>& undisturbed_of(std::size_t column, std::uint64_t run,
                                            std::optional<Flown>* flown = nullptr);
  [[nodiscard]] Result<Flown> fly(scenario::Scenario scenario, const std::string& log) const;
  [[nodiscard]] Result<Flown> fly(const Column& column, std::uint64_t run,
                                  const std::vector<FaultText>& faults, std::int64_t duration_us) const;
  [[nodiscard]] Result<void> keep(const Cell& cell, std::uint64_t run, std::size_t flight,
                                  const std::vector<FaultText>& faults, const Undisturbed* before,
                                  Flown& flown) const;

  const Matrix& matrix_;
  std::string target_;
  std::filesystem::path folder_;
  const std::atomic<bool>& stop_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::unique_ptr<Before>> before_;
  std::mutex mutex_;  // of before_
};

}  // namespace canhil::campaign::matrix
