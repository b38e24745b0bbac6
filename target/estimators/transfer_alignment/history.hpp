#pragma once
// Applies late velocities of the master to the INS state at their time of validity.
#include "target/estimators/filtering/history.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"

namespace canhil::transfer_alignment {

/// The Model of filtering::History for this filter.
struct HistoryModel {
  using State = transfer_alignment::State;
  using Settings = transfer_alignment::Settings;
  using Increment = strapdown::ImuIncrement;
  using Measurement = Eigen::Vector3d;  // master velocity [m/s, NED]
  using UpdateResult = transfer_alignment::UpdateResult;
  using Outcome = transfer_alignment::Outcome;

  /// Advances the state by an IMU increment.
  static void step(State& state, const Increment& imu, const Settings& settings) {
    propagate(state, imu, settings);
  }
  /// See transfer_alignment::prediction_is_due().
  static bool prediction_is_due(const State& state, const Settings& settings) {
    return transfer_alignment::prediction_is_due(state, settings);
  }
  /// See transfer_alignment::predict().
  static void predict(State& state, const Settings& settings) {
    transfer_alignment::predict(state, settings);
  }

  /// Applies a measurement. If there is an `earlier` state, interpolates the velocity by `share` between the
  /// two epochs.
  static UpdateResult update(State& state, const Ins* earlier, double share,
                             const Measurement& master_velocity, const Settings& settings) {
    Eigen::Vector3d velocity = state.ins.nav.v_eb_n;
    if (earlier != nullptr) velocity -= share * (velocity - earlier->nav.v_eb_n);
    return update_with_difference(state, velocity - master_velocity, settings);
  }
  /// The time at which a measurement is applied.
  static std::int64_t applied_at(std::int64_t valid_us, std::int64_t, const Settings&) { return valid_us; }
  /// A refused update changes only the count of rejected velocities.
  static void keep_refusal(State& state, const State& tried) { state.rejected = tried.rejected; }
};

/// filtering::History of the transfer alignment, with the predictions of an outage; about 0.5 kB per
/// increment.
template <std::size_t Capacity, std::size_t Predictions = 4>
using History = filtering::History<HistoryModel, Capacity, Predictions>;

}  // namespace canhil::transfer_alignment
