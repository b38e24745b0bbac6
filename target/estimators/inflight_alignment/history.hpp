#pragma once
// Applies late fixes to the INS state at their time of validity.
#include "target/estimators/filtering/history.hpp"
#include "target/estimators/inflight_alignment/filter.hpp"

namespace canhil::inflight_alignment {

/// The Model of filtering::History for this filter.
struct HistoryModel {
  using State = inflight_alignment::State;
  using Settings = inflight_alignment::Settings;
  using Increment = strapdown::ImuIncrement;
  using Measurement = Fix;
  using UpdateResult = inflight_alignment::UpdateResult;
  using Outcome = inflight_alignment::Outcome;

  /// Advances the state by an IMU increment.
  static void step(State& state, const Increment& imu, const Settings&) { mechanise(state, imu); }
  /// See inflight_alignment::prediction_is_due().
  static bool prediction_is_due(const State& state, const Settings& settings) {
    return inflight_alignment::prediction_is_due(state, settings);
  }
  /// See inflight_alignment::predict().
  static void predict(State& state, const Settings& settings) {
    inflight_alignment::predict(state, settings);
  }

  /// Applies a measurement. If there is an `earlier` state, interpolates the position by `share` between the
  /// two epochs.
  static UpdateResult update(State& state, const Ins* earlier, double share, const Measurement& fix,
                             const Settings& settings) {
    const strapdown::NavState& nav = state.ins.nav;
    GeodeticPosition ins{nav.latitude, nav.longitude, nav.height};
    if (earlier != nullptr) {
      ins.latitude -= share * (nav.latitude - earlier->nav.latitude);
      ins.longitude -= share * (nav.longitude - earlier->nav.longitude);
      ins.height -= share * (nav.height - earlier->nav.height);
    }
    return inflight_alignment::update(state, ins, fix, settings);
  }

  /// The time at which a measurement is applied.
  static std::int64_t applied_at(std::int64_t valid_us, std::int64_t now_us, const Settings& settings) {
    return settings.late_fixes == LateFixes::at_validity ? valid_us : now_us;
  }
  /// A refused update changes only the count of rejected fixes.
  static void keep_refusal(State& state, const State& tried) { state.rejected = tried.rejected; }
};

/// filtering::History of the in-flight alignment, with the filter's own predictions; about 0.4 kB per
/// increment.
template <std::size_t Capacity, std::size_t Predictions = 16>
using History = filtering::History<HistoryModel, Capacity, Predictions>;

}  // namespace canhil::inflight_alignment
