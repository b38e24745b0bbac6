// The campaigns of the paper on the LOS rate, flown, and their figures by name.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/papers/flown.hpp"

namespace canhil::papers::los_rate {

/// A window of the time to go [s].
struct Window {
  double most, least;
};
inline constexpr std::array windows{Window{5.6, 4.5}, Window{4.5, 3},   Window{3, 2},     Window{2, 1},
                                    Window{1, 0.5},   Window{0.5, 0.2}, Window{0.2, 0.08}};
/// Those after the start-up.
inline constexpr std::size_t first_settled = 2;

/// Miss over the runs of a variant [m].
struct Miss {
  double median = 0, rms = 0;  ///< in one plane: of all runs in pitch and yaw
  double of_both = 0;          ///< RMS of the distance
};

struct Results {
  std::vector<Flown> campaigns;
  std::uint64_t runs = 0;  ///< of the campaign open_loop
  std::size_t flights = 0;

  [[nodiscard]] const Flown& of(std::string_view name) const { return papers::of(campaigns, name); }
  /// A figure of an answer; NaN: it has none of that name.
  [[nodiscard]] double figure(std::string_view campaign, std::string_view metric, std::string_view variant,
                              std::string_view name, std::string_view point = {}) const;
  /// RMS of the LOS rate error over both planes [mrad/s].
  [[nodiscard]] double rms(std::string_view campaign, std::string_view variant, const Window& window) const;
  [[nodiscard]] Miss miss(std::string_view campaign, std::string_view variant,
                          std::string_view point = {}) const;
};

/// Flies what the folder does not hold yet. None: stopped. Error: one line.
Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop);

}  // namespace canhil::papers::los_rate
