// The campaigns of a paper, flown, and their answers by name.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/store.hpp"
#include "bench/papers/figure.hpp"

namespace canhil::papers {

/// A TOML file of bench/campaigns/paper_NAME, built into the program: the reproduction needs no source tree.
struct EmbeddedFile {
  std::string_view name;  ///< without its ending
  std::string_view text;
};

/// What a paper flies.
struct Campaigns {
  std::span<const EmbeddedFile> campaigns;
  std::span<const EmbeddedFile> scenarios;  ///< that the campaigns name
};

struct FlyOptions {
  std::filesystem::path folder;       ///< for the results, NAME.sqlite; must exist
  std::optional<std::uint64_t> runs;  ///< in place of the campaigns' own numbers
  Rounding rounding = Rounding::as_on_the_bus;
  std::function<void(std::string_view campaign, std::size_t done, std::size_t total)> progress;
};

/// A campaign with its answers.
struct Flown {
  std::string name;  ///< of the file, without its ending
  campaign::Campaign campaign;
  campaign::Evaluation evaluation;

  /// RMS over runs of a variant, by its name in the file and its point of the sweep; they must exist.
  [[nodiscard]] std::span<const campaign::CurvePoint> curve(
      std::string_view variant, std::string_view point = {},
      const campaign::Quantity& quantity = quantities::attitude_heading) const;
  /// The answer of a metric, by its name, for a variant; it must exist.
  [[nodiscard]] const campaign::Answer& answer(std::string_view metric, std::string_view variant,
                                               std::string_view point = {}) const;
  /// The first answer of a kind of metric for a variant; it must exist.
  [[nodiscard]] const campaign::Answer& answer_of_kind(std::string_view kind, std::string_view variant,
                                                       std::string_view point = {}) const;
  /// Answers that carry a requirement.
  [[nodiscard]] std::vector<const campaign::Answer*> answers(std::string_view requirement) const;
};

/// The campaign of this name; it must exist.
const Flown& of(const std::vector<Flown>& flown, std::string_view name);

/// Flights of all variants of all campaigns.
std::size_t flights(const std::vector<Flown>& flown);

/// Adds a point of an RMS over runs to a curve at x, with the 95 % range that the scatter over the runs gives
/// it; `unit` [SI] is that of the figure.
void add_rms(Curve& curve, double x, const campaign::CurvePoint& point, double unit = 1);

/// A figure of an answer, by its name in the report; NaN: it has none.
double figure(const campaign::Answer& answer, std::string_view name);

/// How the campaigns of a paper were flown, all alike.
Rounding rounding_of(const std::vector<Flown>& flown);

/// "frames quantised as on the bus", or that they were not.
std::string_view frames_flown(const std::vector<Flown>& flown);

/// A campaign with the answers that its results give. Error: results cannot be read, or runs are missing.
Result<Flown> evaluated(std::string name, campaign::Campaign campaign, const campaign::Store& store);

/// The results of one campaign in the folder.
std::filesystem::path results_file(const FlyOptions& options, std::string_view campaign);

/// Flies what the folder does not hold yet. None: stopped. Error: one line.
Result<std::optional<std::vector<Flown>>> fly(const Campaigns& files, const FlyOptions& options,
                                              const std::atomic<bool>& stop);

}  // namespace canhil::papers
