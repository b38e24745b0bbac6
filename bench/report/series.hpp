// Estimates against the truth over the time of a run, in as many points as a picture has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/session.hpp"

namespace canhil::report {

struct Series {
  static constexpr std::size_t max_points = 300;
  enum class Kind : std::uint8_t { error, innovation, statistic };
  struct Point {
    double t_s = 0;
    double low = 0, high = 0;     ///< the quantity covers this until the next point
    std::optional<double> sigma;  ///< the largest that the target told
  };
  std::string estimator;
  std::string quantity;
  std::string unit;
  Kind kind = Kind::error;
  std::vector<Point> points;
  std::vector<double> between;  ///< of a statistic: 95 % of the values of a consistent filter lie here
};

/// Of every estimator that the scenario runs.
std::vector<Series> series(const scenario::Scenario& scenario, const run::Run& run);

}  // namespace canhil::report
