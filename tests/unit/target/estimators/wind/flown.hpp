#pragma once
// Passes the recorded run to step() in the order of the bus; a test can change the input.
#include <functional>

#include "target/estimators/filtering/cholesky.hpp"
#include "tests/unit/target/estimators/wind/recorded_run.hpp"

namespace canhil::wind {

struct FinFrame {
  std::int64_t t_us = 0;
  Deflection deflection;
  bool arrives = true;
};

/// Changes row k's frames before they reach the filter.
using Spoil = std::function<void(std::size_t k, Navigation&, FinFrame&)>;

struct Flown {
  std::vector<UpdateResult> results;
  std::vector<State> states;
  std::vector<double> wind_error;  // [m/s]

  double mean_error(std::size_t from, std::size_t to) const {
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) sum += wind_error[k];
    return sum / static_cast<double>(to - from);
  }
};

inline Flown fly(
    const RecordedRun& run, const Settings& settings, const Spoil& spoil = [](auto...) {}) {
  const Design design = make_design(settings);
  State state = run.release();
  FinHistory fins;
  Flown flown;
  for (std::size_t k = 0; k < run.y.size(); ++k) {
    Navigation navigation = run.navigation(k);
    FinFrame frame{RecordedRun::t_us(k), run.inputs[k].fins};
    spoil(k, navigation, frame);
    if (frame.arrives) fins.push(frame.t_us, frame.deflection, design.airframe.deflection_most);
    flown.results.push_back(step(state, navigation, fins, design));
    flown.states.push_back(state);
    flown.wind_error.push_back((state.x.tail<3>() - run.true_wind(k)).norm());
  }
  return flown;
}

}  // namespace canhil::wind
