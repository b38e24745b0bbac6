// Flies the runs of a campaign.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/matrix/flights.hpp"
#include "bench/campaign/row.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// The scenario of a run. With faults, it contains those of the run, the checks of the matrix and a seed of
/// its own; without faults, the number of the run selects its random numbers (drive::Options::run_index).
/// Error: one line.
Result<scenario::Scenario> scenario_of(const Campaign& campaign, const Key& key);

class Flights {
 public:
  /// `target`: a program to fly against; empty: a Device in this process. `folder`: of the scenarios that
  /// show violations. All references must outlive the flights.
  Flights(const Campaign& campaign, const std::string& target, const std::filesystem::path& folder,
          const std::atomic<bool>& stop);

  /// Computes the truths of these runs. Error, one line: a variant cannot be flown.
  Result<void> prepare(std::span<const Key> runs);

  /// Flies a run. May be called from several threads. None: it was interrupted. Error, one line: the run
  /// cannot be flown.
  Result<std::optional<Finished>> fly(const Key& key);

 private:
  Result<std::optional<Finished>> observe(const Key& key) const;
  Result<std::optional<Finished>> judge(const Key& key) const;
  Result<std::optional<Finished>> respond(const Key& key);
  [[nodiscard]] Error in_variant(std::size_t variant, const Error& error) const;

  const Campaign& campaign_;
  const std::string& target_;
  const std::atomic<bool>& stop_;
  std::vector<std::optional<world::FlightRecord>> truths_;  // of each variant to be flown
  std::optional<matrix::Flights> with_faults_;
};

}  // namespace canhil::campaign
