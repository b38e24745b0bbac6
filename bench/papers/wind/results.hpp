// The campaigns of the paper on wind, flown, and their scores by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/papers/flown.hpp"

namespace canhil::papers::wind {

/// Mean over t >= 10 s of |error of the wind| of each run; of these, mean and standard deviation over the
/// runs [m/s].
struct Score {
  double mean = 0;
  double standard_deviation = 0;
};
/// "0.87 (0.23)".
std::string words(const Score& score);

struct Results {
  std::vector<Flown> campaigns;
  std::uint64_t runs = 0;  ///< of the campaign of Table 1
  std::size_t flights = 0;

  [[nodiscard]] const Flown& of(std::string_view name) const { return papers::of(campaigns, name); }
  /// `metric`: "wind error" (all three components), "along track", "cross track" or "down".
  [[nodiscard]] Score score(std::string_view campaign, std::string_view variant,
                            std::string_view metric = "wind error") const;
  /// Of the 3-D error; runs that were lost.
  [[nodiscard]] std::size_t lost(std::string_view campaign, std::string_view variant) const;
};

/// Flies what the folder does not hold yet. None: stopped. Error: one line.
Result<std::optional<Results>> fly(const FlyOptions& options, const std::atomic<bool>& stop);

}  // namespace canhil::papers::wind
